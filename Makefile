# Commands of the project; `make help` lists them.
PYTHON := .venv/bin/python
ROBOT ?= patrol
# empty for the robot's own world
WORLD ?=
export PYTHONPATH := $(CURDIR)

.PHONY: help setup voice video setup-test setup-js run demo test test-fast test-slow mutate bench android-check gallery layout-lint lint format

help: ## list the commands
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 16

setup: ## install what running needs into .venv, if missing: app, robot side, simulator
	@bash scripts/setup.sh

voice: ## install what spoken commands and the voice that answers need
	@bash scripts/setup.sh voice

video: ## install what film and WebRTC of the camera need
	@bash scripts/setup.sh video

setup-test: ## install what tests, benches and lint need
	@bash scripts/setup.sh voice test

setup-js: ## install the JavaScript library that tests/clients drive the robot with
	@bash scripts/setup.sh clients

run: setup ## open the app on the built-in simulator; options ROBOT=scout,patrol WORLD=office
	@PYTHON=$(PYTHON) ROBOT=$(ROBOT) WORLD=$(WORLD) bash scripts/run.sh

demo: setup ## scripted stories, through the app's own touch events: out/demo*/; option ROBOT=scout or ROBOT=all
	@PYTHON=$(PYTHON) bash scripts/demo.sh $(ROBOT)

test: setup-test ## run the tests but the slow ones, no display needed
	@bash scripts/setup.sh clients || true # the tests that need it say so
	@PYTHON=$(PYTHON) bash scripts/test.sh

test-fast: setup-test ## run the tests of pure logic, in a minute: messages, protocol, layouts, control, limits, planning, tasks, physics
	@PYTHON=$(PYTHON) bash scripts/test.sh fast

test-slow: setup-test ## run the rest: simulated physics, real processes, every sequence of control and STOP
	@PYTHON=$(PYTHON) bash scripts/test.sh slow

mutate: setup-test ## put faults into the code, each of which a test must notice; option ONLY=word
	@$(PYTHON) scripts/mutate.py --only "$(ONLY)"

bench: setup-test ## run all benches: out/bench/*.json and a table
	@$(PYTHON) -m bench

android-check: setup-test ## check the APK as far as possible without Google's toolchain
	@bash scripts/setup.sh android
	@$(PYTHON) -m scripts.android

gallery: setup ## draw every widget in every state and theme: out/gallery/index.html
	@$(PYTHON) -m widgets --out out/gallery

layout-lint: setup-test ## look for words cut, small or covered targets on all screens, sizes and languages: out/layout_lint/report.md; option WAYS="de 130"
	@$(PYTHON) -m tests.layout_lint --only "$(WAYS)"

lint: setup-test ## run ruff, the format check and mypy
	@$(PYTHON) -m ruff check .
	@$(PYTHON) -m ruff format --check .
	@$(PYTHON) -m mypy

format: setup-test ## format the code with ruff
	@$(PYTHON) -m ruff format .
	@$(PYTHON) -m ruff check --fix .
