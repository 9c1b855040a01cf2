# The habits of the project. `make demo` and `make test` work on a fresh machine with Python 3.11+.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip install --quiet --constraint constraints.txt
PROMPT ?= A fruit bowl with an apple, an orange and a pear, a stack of three books with a red mug on top, and next to it a pen holder holding two pencils and a ruler.

.DEFAULT_GOAL := help
.PHONY: help setup setup-dev engines demo format check test quick test-all docs bench transfer clean

help:  ## list the targets
	@grep -E '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed 's/:.*## /\t/' | expand -t 14

$(VENV)/.made:
	$(PYTHON) -m venv $(VENV)
	@touch $@

$(VENV)/.setup: $(VENV)/.made pyproject.toml constraints.txt
	$(PIP) --editable '.[usd]'
	@touch $@

# robosuite asks for packages that need a GL library, an older numpy or a compiler, and uses none of them here.
$(VENV)/.setup-dev: $(VENV)/.setup
	$(PIP) --editable '.[dev,torch,usd,meshes,envs]'
	$(PIP) numba opencv-python-headless termcolor pyarrow websockets msgpack imageio-ffmpeg h5py cryptography
	$(PIP) --no-deps robosuite mujoco-menagerie
	@touch $@

# Environments are among the documented classes.
$(VENV)/.setup-docs: $(VENV)/.setup
	$(PIP) --editable '.[docs,envs]'
	@touch $@

setup: $(VENV)/.setup  ## create .venv with the pinned packages and the pat3d command

setup-dev: $(VENV)/.setup-dev  ## the same with the packages that the tests need

engines: setup  ## virtual environments of MuJoCo, Newton, PyBullet, Drake and PhysX for pat3d check --engines
	$(BIN)/python -m pat3d.check.engines.environments

engine-%: setup
	$(BIN)/python -m pat3d.check.engines.environments $*

demo: setup  ## a sentence to a verified scene: scenes/demo
	$(BIN)/pat3d generate "$(PROMPT)" --out scenes/demo --seed 0

format: setup-dev  ## sort imports and format
	$(BIN)/ruff check --fix --quiet .
	$(BIN)/ruff format --quiet .

check: setup-dev  ## lint and types
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/pyright

# The type checker has one thread: beside the tests it costs little time.
test: setup-dev  ## lint, types and the quick tests
	@$(MAKE) --no-print-directory --jobs 2 check quick

quick: setup-dev  ## the quick tests alone
	$(BIN)/pytest -m 'not slow' --numprocesses auto --dist loadfile

test-all: check  ## every test, the slow ones too
	$(BIN)/pytest --numprocesses auto

docs: $(VENV)/.setup-docs  ## the documentation as a site: build/docs/index.html
	$(BIN)/python -m sphinx --fail-on-warning --keep-going -q docs build/docs

bench: setup-dev  ## generation of the paper's prompts, as in benchmarks/RESULTS.md
	$(BIN)/python benchmarks/generate.py

transfer: setup-dev  ## drift in every engine that is there
	$(BIN)/python benchmarks/transfer.py --prompts benchmarks/prompts.txt --random 100 --out transfer.md

clean:  ## remove the environment and the caches
	rm -rf $(VENV) build *.egg-info .pytest_cache .ruff_cache .hypothesis
