"""The window as the scan sees it: targets read from the widget tree, the mark drawn over them, and touches made for a switch."""
