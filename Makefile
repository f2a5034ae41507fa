# The menu of verbs; `make help` lists them.
PYTHON := .venv/bin/python
ROBOT ?= patrol
# that of the robot, unless it is said
WORLD ?=
export PYTHONPATH := $(CURDIR)

.PHONY: help setup run demo test test-fast bench android-check gallery lint format

help: ## this list
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 16

setup: ## make .venv and what it needs; nothing to do when it is there
	@bash scripts/setup.sh

run: setup ## open the app on the built-in simulator; ROBOT=scout,patrol WORLD=office choose
	@PYTHON=$(PYTHON) ROBOT=$(ROBOT) WORLD=$(WORLD) bash scripts/run.sh

demo: setup ## stories by script, through the app's own touch events: out/demo*/; ROBOT=scout or all chooses
	@PYTHON=$(PYTHON) bash scripts/demo.sh $(ROBOT)

test: setup ## all tests, no display needed
	@PYTHON=$(PYTHON) bash scripts/test.sh

test-fast: setup ## the tests that take less than a minute
	@PYTHON=$(PYTHON) bash scripts/test.sh fast

bench: setup ## benchmarks: out/bench/*.json and a table
	@$(PYTHON) -m bench

android-check: setup ## what can be proven of the APK without its toolchain
	@$(PYTHON) scripts/android_check.py

gallery: setup ## every widget in every state and theme: out/gallery/index.html
	@$(PYTHON) -m widgets --out out/gallery

lint: setup ## ruff, format check, mypy
	@$(PYTHON) -m ruff check .
	@$(PYTHON) -m ruff format --check .
	@$(PYTHON) -m mypy

format: setup ## let ruff lay the code out
	@$(PYTHON) -m ruff format .
	@$(PYTHON) -m ruff check --fix .
