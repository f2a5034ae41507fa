"""Parts that the benches share: figures and their arithmetic, the machine's noise, tables, child processes."""
