"""Checks of the Android package that need no SDK and no NDK; they build no package that a phone would take.

`package` is what goes in and how it is asked for, `shaders` what the phone's graphics compile, `recipes` what python-for-android makes
of the requirements, `manifest` what Android is told of the app, `java_names` and `permissions` what the app asks of Android, `libraries`
the compiled files, and `bare_run` the app itself with nothing but what the phone has. `python -m scripts.android` runs them all.
"""
