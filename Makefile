# fixdem: what a user does with cases and tests; further targets are in tools/make/, one file for each kind of work. `make help`
# lists all. tools/make/variant.mk holds the flags, tools/make/rules.mk says how each file is made.
#
# Targets are thin: they see to it that what they need is installed (tools/deps/deps.sh, silent when all is
# there), then call make once more, on all cores, for the files.

include tools/make/variables.mk

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
MAKEFLAGS += --no-builtin-rules --no-print-directory
.SUFFIXES:
.SECONDARY:
.DELETE_ON_ERROR:
.DEFAULT_GOAL := help

ifneq ($(filter default undefined,$(origin CXX)),)
CXX := g++
endif
CASE ?= plug_u24
ARCH ?= native

# Some targets do one thing for a case that is asked for, and another without.
case_given := $(filter command environment,$(origin CASE))

include tools/make/variant.mk
include tools/make/stale.mk
include tools/make/rules.mk
include tools/make/stability.mk
include tools/make/embedded.mk
include tools/make/footprint.mk
include tools/make/frontier.mk
include tools/make/fuzz.mk
include tools/make/check.mk
include tools/make/run_report.mk
include tools/make/figures.mk
include tools/make/lammps.mk
include tools/make/sweep.mk
include tools/make/validate.mk
include tools/make/bench.mk
include tools/make/pictures.mk
include tools/make/systems.mk
include tools/make/validate_contacts.mk

# All cores, unless the caller has already said how many.
parallel = $(if $(findstring jobserver,$(MAKEFLAGS)),,-j$(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1))
files = +@$(MAKE) $(parallel)
needs = @CXX='$(CXX)' INCLUDES='$(system_includes)' tools/deps/deps.sh

.PHONY: help
help:  ## this list
	@echo 'make TARGET [VARIABLE=value ...]'
	@sed -nE 's/^([a-z-]+):.*## (.*)/  \1\t\2/p' $(filter Makefile tools/make/%.mk,$(MAKEFILE_LIST)) | expand -t 16
	@echo 'Variables:'
	@sed -nE 's/^about\.([A-Z_]+) := (.*)/  \1\t\2/p' tools/make/variables.mk | expand -t 18

.PHONY: run
run:  ## build and run CASE, and first the case it starts from; results in OUT; RESUME=1 goes on with it, EXTEND=s makes it longer, FRESH=1 begins anew
	$(needs) run
	$(files) build-program
	$(files) start-state
	@$(read_start); $(same_text); inputs=; $(if $(is_whole_run),$(if $(FRESH),,[ -e $(out)/final.fixdem ] || )$(inputs);) \
	  $(call run_case,$(out)) $(how) $(watching); $(leave_mark)

.PHONY: watch
watch: watching := --watch
watch: run  ## the same with a live picture of the pipe in the terminal instead of the table

.PHONY: test
test:  ## build and run every test; ends with "N passed, M failed"
	$(needs) run test $(if $(SAN),,frontier sweep) $(if $(filter memory,$(SAN)),check)
	$(if $(filter memory,$(SAN)),$(files) $(INSTRUMENTED)/lib/libc++.a)
	+@$(MAKE) $(parallel) build-tests && { [ -n '$(SAN)' ] || $(MAKE) $(parallel) build-frontier CASE=settle QUICK=1; } || \
	  { echo '0 passed, 1 failed'; exit 1; }
	@PROGRAM_ONLY='$(filter memory,$(SAN))' FRONTIER='$(if $(SAN),,$(build)/frontier/settle-quick)' KILLS='$(if $(SAN),,100)' SWEEP_PYTHON="$(if $(SAN),,$(sweep_python))" NUMPY_PYTHON="$(numpy_python)" \
	  tests/run.sh '$(build)' '$(CXX)' $(test_flags)

.PHONY: soak
soak:  ## kill runs at random moments, in writing too, and resume them, for TIME=600 seconds; prints the figures
	$(needs) run test
	$(files) $(addprefix $(build)/bin/,$(soak_cases))
	+@$(MAKE) final-state CASE=fill_500 $(plainly)
	@mkdir -p $(build)/scratch
	@tests/kill_test.py $(build)/bin $(build)/scratch/soak --starts out --time $(or $(TIME),600)

.PHONY: golden
golden:  ## pin the final states of all cases anew (tests/golden/) and print what has changed
	$(needs) run test
	$(files) build-golden
	@FIXDEM_RENEW_GOLDEN=1 FIXDEM_GOLDEN_ALL='$(golden_all)' $(build)/tests --test-case='golden*' --no-intro

.PHONY: cases
cases:  ## build the program of every case in cases/ and list them
	$(needs) run
	$(files) build-cases
	@for case in $(case_names); do printf '%-16s %s\n' "$$case" "$$(sed -n 's/^title *= *"\(.*\)"/\1/p' "cases/$$case.toml")"; done

.PHONY: header
header:  ## print the header that is generated from CASE
	$(needs) run
	$(files) $(case_header) >&2
	@cat $(case_header)

.PHONY: asm
asm:  ## show the hot loop of CASE's program in assembly
	$(needs) run
	$(files) build-program >&2
	@objdump -d -C --no-show-raw-insn $(case_program) | awk -f tools/make/hot_loop.awk

.PHONY: format
format:  ## format every source file in place
	$(needs) check
	@clang-format -i $(sources)

.PHONY: deps
deps:  ## install what running and testing need; nothing when all is there
	$(needs) run test

.PHONY: clean
clean:  ## remove everything built; results in out/ stay
	@[ ! -e $(BUILD) ] || [ -e $(BUILD)/sources.sha256 ] || [ '$(BUILD)' = build ] || \
	  { echo 'fixdem: $(BUILD) is no folder that this make has built in: nothing is removed' >&2; exit 2; }
	rm -rf $(BUILD)
