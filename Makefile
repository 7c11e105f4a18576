# fixdem: every target. `make help` lists them; tools/make/variant.mk holds the flags, tools/make/rules.mk says how each
# file is made.
#
# The targets below are thin: they see to it that what they need is installed (tools/deps/deps.sh, silent when all is
# there), then call make once more, on all cores, for the files.

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
QUICK ?=
ARCH ?= native
LANES ?=
SEED ?=
ARGS ?=
FILTER ?=
JSON ?=
LMP ?=
STEPS ?=
RESUME ?=

# Some targets do one thing for a case that is asked for, and another without.
case_given := $(filter command environment,$(origin CASE))

include tools/make/variant.mk
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

# All cores, unless the caller has already said how many.
parallel = $(if $(findstring jobserver,$(MAKEFLAGS)),,-j$(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1))
files = +@$(MAKE) $(parallel)
needs = @CXX='$(CXX)' INCLUDES='$(system_includes)' tools/deps/deps.sh

.PHONY: help
help:  ## this list
	@echo 'make TARGET [CASE=$(CASE)] [CXX=$(CXX)] [ARCH=$(ARCH)] [LANES=n] [OUT=out/CASE] [SEED=n] [ARGS="--duration 0.1 ..."]'
	@sed -nE 's/^([a-z-]+):.*## (.*)/  \1\t\2/p' Makefile | expand -t 16
	@echo 'CASE is a name in cases/ or the path of any .toml file. ARCH: native, scalar, x86-64-v4, x86-64-v3 or x86-64.'

.PHONY: run
run:  ## build and run CASE, and first the case it starts from; results in OUT; RESUME=1 (or a checkpoint) goes on with a run
	$(needs) run
	$(files) build-program
	$(files) start-state
	@$(read_start); $(call run_case,$(OUT)) $(resume) $(watching)$(if $(RESUME),,$(if $(filter $(usual),$(OUT)),; $(leave_mark)))

.PHONY: watch
watch: watching := --watch
watch: run  ## the same with a live picture of the pipe in the terminal instead of the table

.PHONY: test
test:  ## build and run every test; ends with "N passed, M failed"
	$(needs) run test $(if $(SAN),,frontier sweep) $(if $(filter memory,$(SAN)),check)
	$(if $(filter memory,$(SAN)),$(files) $(INSTRUMENTED)/lib/libc++.a)
	+@$(MAKE) $(parallel) build-tests && { [ -n '$(SAN)' ] || $(MAKE) $(parallel) build-frontier CASE=settle QUICK=1; } || \
	  { echo '0 passed, 1 failed'; exit 1; }
	@PROGRAM_ONLY='$(filter memory,$(SAN))' FRONTIER='$(if $(SAN),,$(build)/frontier/settle-quick)' KILLS='$(if $(SAN),,100)' SWEEP_PYTHON="$(if $(SAN),,$(sweep_python))" \
	  tests/run.sh '$(build)' '$(CXX)' $(test_flags)

.PHONY: soak
soak:  ## kill runs at random moments, in writing too, and resume them, for TIME=600 seconds; prints the figures
	$(needs) run test
	$(files) $(addprefix $(build)/bin/,$(soak_cases))
	+@$(MAKE) final-state CASE=fill_500 SEED= OUT= ARGS=
	@mkdir -p $(build)/scratch
	@tests/kill_test.py $(build)/bin $(build)/scratch/soak --starts out --time $(or $(TIME),600)

.PHONY: identical
identical:  ## run the same scenes, or CASE, on every instruction set and on a bare board, and compare the last bit; STEPS=n
	$(needs) run $(if $(filter aarch64,$(identical_all)),identical embedded)
	+@$(MAKE) $(if $(case_given),identical-case,identical-scenes)

.PHONY: identical-case identical-scenes
identical-scenes:
	$(files) build-identical
	@tests/identical/run.sh '$(build)/identical/count' '$(build)/identical' '' tests/golden/scenes.txt $(identical_all)

identical-case:
	$(files) case-start
	$(files) build-identical-case
	@tests/identical/run.sh '$(embedded)/count' '$(embedded)' '$(STEPS)' $(identical_all)

.PHONY: embedded
embedded:  ## run CASE on a bare board (Cortex-M7, emulated) and on this machine, and compare the last bit; STEPS=n
	$(needs) run embedded
	$(files) case-start
	$(files) build-embedded $(embedded)/native
	@tools/embedded/run.sh $(embedded)/cortex-m7 $(STEPS) | tee $(embedded)/board.txt
	@$(embedded)/native $(STEPS) >$(embedded)/here.txt
	@echo "on this machine:  $$(tail -n 1 $(embedded)/here.txt)"
	@diff <(sed '/^#/d' $(embedded)/board.txt) <(sed '/^#/d' $(embedded)/here.txt) && echo 'every line is the same, to the last bit'

.PHONY: footprint
footprint:  ## memory, code, instructions and cycles of every case and of a scene stripped step by step: kernel/README.md
	$(needs) run footprint
	+@for case in $(case_names); do $(MAKE) case-start CASE=$$case; $(MAKE) build-footprint CASE=$$case; done
	@tools/footprint/footprint.py --strips $(footprint)/strips --programs $(footprint)/cases --headers $(build)/cases \
	  --readme kernel/README.md $(case_names)

.PHONY: fuzz
fuzz:  ## throw hostile cases, state files and particles at the readers and the kernel for TIME seconds in all
	$(needs) run test fuzz
	$(files) build-fuzz
	@tests/fuzz/run.sh $(fuzz) $(TIME) $(fuzz_targets)

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

# Every folder of a final state that the standard set of benchmarks starts from: bench/main.cpp.
bench_states := pipe_bed settle plug_u24

.PHONY: bench bench-set bench-case
bench:  ## time whole steps and their stages (Google Benchmark), or the steps of CASE alone; FILTER=regex, JSON=file
	$(needs) run bench
	+@$(MAKE) $(if $(case_given),bench-case,bench-set)

bench-set:
	$(files) build-bench
	+@for state in $(bench_states); do $(MAKE) final-state CASE=$$state SEED= OUT= ARGS=; done
	@$(build)/bench out $(bench_options)

bench-case:
	$(files) $(case_bench)
	+@$(read_start); final=$(usual)/final.fixdem; \
	if [ -e $$final ]; then state="final $$final"; \
	elif [ -n '$(SEED)' ]; then echo "fixdem: there is no $$final: run the case with this SEED first" >&2; exit 3; \
	elif [ -n "$$from" ]; then $(MAKE) final-state CASE="$$from" ARGS=; state="start $$start"; \
	else state=start; fi; \
	$(case_bench) $$state $(bench_options)

.PHONY: bench-report
bench_runs := $(foreach n,1 2 3 4 5,$(build)/bench-report-$n.json)
bench-report:  ## run the benchmarks five times (or read JSON=file): table, picture and bench/README.md
	$(needs) run bench report
	+@[ -n '$(JSON)' ] || { set -e; for json in $(bench_runs); do $(MAKE) bench-set JSON=$$json FILTER=; done; }
	tools/bench_report/bench_report.py $(or $(JSON),$(bench_runs)) --reports bench/reports --readme bench/README.md --head README.md

.PHONY: bench-peers
bench-peers:  ## fixdem beside LAMMPS and LIGGGHTS, same scenes, one core; LMP=/path/to/lmp, JSON=file; rewrites the table in bench/README.md
	$(needs) run peers $(if $(LMP),,lammps)
	$(files) build-peers
	+@$(MAKE) final-state CASE=pipe_bed OUT= SEED= ARGS=
	tools/peers/bench_peers.py --programs $(peers)/bin --headers $(peers)/cases --settled out/pipe_bed/final.fixdem \
	  --out out/peers --readme bench/README.md $(if $(LMP),--lmp '$(LMP)') $(if $(JSON),--json '$(JSON)')

.PHONY: export-lammps
export-lammps:  ## CASE as input for LAMMPS in out/lammps/CASE, from its start or STATE=file; REPEAT=n copies along a periodic pipe
	$(needs) run export
	$(files) $(case_header) $(if $(STATE),,build-program)
	+@$(MAKE) lammps-state
	@tools/lammps/export_lammps.py $(lammps_files)

.PHONY: run-lammps
run-lammps:  ## the same, run over MPI with RANKS=n processes, the gas beside it; STEPS=n; LMP=/path/to/lmp for a case without gas
	$(needs) run export mpi $(if $(LMP),,lammps)
	+@$(MAKE) export-lammps
	+@[ -z "$$($(lammps_has_gas))" ] || { $(needs:@%=%) lammps-library; $(MAKE) $(parallel) build-gas-beside; }
	@tools/lammps/run_lammps.py $(lammps_out) --header $(case_header) $(if $(REPEAT),--repeat $(REPEAT)) --ranks $(RANKS) \
	  --mpirun '$(MPIRUN)' $(if $(STEPS),--steps $(STEPS)) $$([ -n "$$($(lammps_has_gas))" ] && echo --program $(gas_beside) || \
	  echo --program '$(or $(LMP),lmp)')

.PHONY: test-lammps
test-lammps:  ## LAMMPS beside the kernel: impacts, trajectories, gas, ranks, every case, a plug (some minutes); ONLY=part; README=1: tables
	$(needs) run test export mpi lammps lammps-library
	+@$(MAKE) build-test-lammps
	@tests/lammps/lammps_test.py --build $(build) --headers $(build) --impact-build $(lammps_impacts) --states $(lammps_test)/states \
	  --out $(lammps_test)/runs $(if $(ONLY),--only $(ONLY)) $(if $(README),--readme tools/lammps/README.md)

.PHONY: bench-scaling
scaling_runs := $(foreach n,1 2 3,$(build)/bench-scaling-$n.json)
scaling_sweep = out/scaling/sweep-on-$(1)
bench-scaling:  ## throughput of one core, of a sweep on 1 and 2 cores, of LAMMPS on 1 and 2 ranks, and when to leave one core: bench/README.md
	$(needs) run bench report sweep export mpi lammps
	+@for json in $(scaling_runs); do $(MAKE) bench-set JSON=$$json FILTER='^step/bed/10+/double'; done
	+@for n in 1 2; do rm -rf $(call scaling_sweep,$$n); $(MAKE) sweep SWEEP=cases/sweeps/throughput.toml OUT=$(call scaling_sweep,$$n) JOBS=$$n; done
	tools/scaling/bench_scaling.py --bench $(scaling_runs) --sweeps $(foreach n,1 2,$(call scaling_sweep,$n)/sweep.json) \
	  --header $(build)/cases/pipe_bed.hpp --state out/pipe_bed/final.fixdem --out out/scaling/lammps --lmp '$(or $(LMP),lmp)' \
	  --mpirun '$(MPIRUN)' --readme bench/README.md --picture bench/reports/scaling

.PHONY: stability
stability_out = $(if $(QUICK),$(stability)/page,bench/reports/$(case_name))
stability:  ## how far CASE is from instability: page, tables and pictures in bench/reports/CASE; QUICK=1 is the part of it in make test
	$(needs) run test $(if $(QUICK),,report)
	+@$(MAKE) final-state CASE='$(case_file)' OUT= SEED= ARGS=
	+tools/stability/stability.py --case-file $(case_file) --casegen $(casegen) --folder $(stability) --results $(usual) \
	  --make '$(MAKE) $(parallel) CASE=$(case_file)' --out $(stability_out) $(if $(QUICK),--quick)

.PHONY: frontier
frontier:  ## error against run time for CASE: bench/reports/CASE/frontier.md; QUICK=1: a part, to try it out
	$(needs) run frontier
	$(files) build-program
	+@$(MAKE) final-state OUT= SEED= ARGS=
	$(files) $(frontier)/truth
	$(files) build-frontier
	+@$(read_start); [ -z "$$from" ] || $(MAKE) build-program CASE="$$from"
	@$(read_start); tools/frontier/frontier.py --programs $(frontier) --case $(case_name) --header $(case_header) \
	  --state $(frontier_state) $${from:+--fill $(build)/bin/$$(basename "$$from" .toml)} $(if $(QUICK),--quick) \
	  --out $(if $(QUICK),$(frontier)/report,bench/reports/$(case_name))

.PHONY: check
check:  ## formatting, clang-tidy, cppcheck, all pinned states, valgrind, and the tests under sanitizers (address, behaviour, memory)
	$(needs) run test check
	@clang-format --dry-run -Werror $(sources)
	$(files) build-tidy build-checked
	$(files) build-golden
	@FIXDEM_GOLDEN_ALL='$(golden_all)' $(build)/tests --test-case='golden*' --no-intro
	@$(MAKE) check-valgrind $(if $(filter x86_64 amd64,$(machine)),ARCH=x86-64-v3)
	@$(MAKE) test SAN=1
	@$(MAKE) test SAN=memory CXX=clang++

.PHONY: format
format:  ## format every source file in place
	$(needs) check
	@clang-format -i $(sources)

.PHONY: plug-table
plug-table:  ## run the five plugs from three seeds of each fill (those not yet run) and rewrite the table in cases/README.md
	$(needs) run table
	$(files) $(addprefix $(build)/bin/,$(plug_cases))
	tools/plug_table/plug_table.py --programs $(build)/bin --out out/plug_table --jobs $(JOBS) cases/README.md

.PHONY: figures
figures:  ## the paper's figures from runs of our own (those not yet made): cases/gallery/ and cases/README.md; JOBS=1: one at a time
	$(needs) run table report picture figures
	$(files) build-figures
	+@$(MAKE) final-state CASE=settle OUT= SEED= ARGS=
	@$(numpy_python) tools/figures/figures.py cases/README.md --out cases/gallery --programs $(build)/bin --impacts $(figure_impacts) \
	  --decays $(figure_decays) --jobs $(JOBS)

.PHONY: sweep
sweep:  ## many runs of one case with values that vary: SWEEP=file; ENGINE=parallel (HOSTS=list) or slurm; JOBS=n at a time; only those missing
	$(needs) run sweep $(filter slurm,$(ENGINE))
	$(files) $(casegen)
	+@$(sweep_python) tools/sweep/sweep.py '$(SWEEP)' $(sweep_options) --make '$(MAKE) $(parallel) SWEEP=$(SWEEP) OUT=$(sweep_out)'

.PHONY: test-sweep
test-sweep:  ## sweeps over two hosts and through Slurm, with a host and a node that die in the middle; as root
	$(needs) run sweep slurm clusters
	$(files) $(casegen)
	@$(sweep_python) tests/sweep/failing_test.py $(build)/scratch/sweep-failing
	@$(sweep_python) tests/sweep/hosts_test.py $(build)/scratch/sweep-hosts
	@$(sweep_python) tests/sweep/slurm_test.py $(build)/scratch/sweep-slurm

.PHONY: report
report:  ## a page about the last run of CASE, or about a run made now: OUT/report.html, opens in any browser
	$(needs) run page
	$(files) build-program build-page
	+@[ -e $(OUT)/summary.json ] || $(MAKE) run
	@$(numpy_python) tools/run_report/run_report.py $(OUT) $(OUT)/report.html --case $(case_file) --program $(case_program) --bundle $(page_bundle)

.PHONY: test-report
test-report:  ## the page of settle (or CASE) in a headless browser; PICTURES=folder keeps what it looked like
	$(needs) run page browser
	$(files) $(page_folder)/installed-for-tests
	+@$(MAKE) report CASE=$(if $(case_given),$(case_file),settle)
	@$(if $(PICTURES),mkdir -p $(PICTURES);) case=$(if $(case_given),$(case_name),settle); $(numpy_python) tests/run_report/run_report_test.py \
	  out/$$case out/$$case/report.html $(if $(case_given),$(case_file),cases/settle.toml) $(page_folder) "$$(command -v chromium)" $(PICTURES)

.PHONY: pictures
pictures:  ## run plug_u24 and redraw the picture of the README (cases/gallery/)
	$(needs) run picture
	@$(MAKE) run CASE=plug_u24 OUT=out/picture ARGS='--quiet'
	tools/picture/picture.py out/picture cases/gallery/plug_u24 --case cases/plug_u24.toml

.PHONY: movie
movie:  ## a movie of the last run of CASE, or of a run made now: OUT/movie.mp4, or FORMAT=gif; SECONDS=10 long
	$(needs) run movie
	$(files) build-program
	+@[ -e $(OUT)/summary.json ] || $(MAKE) run
	@$(numpy_python) tools/movie/movie.py $(OUT) $(OUT)/movie.$(or $(FORMAT),mp4) --case $(case_file) --seconds $(or $(SECONDS),10)

.PHONY: test-movie
test-movie:  ## a short movie of settle: its pictures, and that it plays
	$(needs) run movie
	+@$(MAKE) final-state CASE=settle OUT= SEED= ARGS=
	@$(numpy_python) tests/movie_test.py out/settle $(build)/scratch

.PHONY: render
render:  ## render CASE's frames with ParaView into OUT/render.png
	$(needs) render
	xvfb-run -a pvpython --force-offscreen-rendering tools/picture/render_paraview.py $(OUT) $(OUT)/render.png

.PHONY: test-paraview
read_with_paraview = pvpython --force-offscreen-rendering tests/paraview_test.py
text_case := $(build)/scratch/settle_as_text
test-paraview:  ## the frames of settle, binary and as text, or of CASE read back by ParaView's own reader
	$(needs) run render
	+@$(MAKE) final-state CASE=$(if $(case_given),$(case_file),settle) OUT= SEED= ARGS=
	@$(read_with_paraview) out/$(if $(case_given),$(case_name),settle) $(if $(case_given),$(case_file),cases/settle.toml)
	@$(if $(case_given),,mkdir -p $(build)/scratch; sed '/^frame_interval/a frame_data = "text"' cases/settle.toml >$(text_case).toml)
	+@$(if $(case_given),,$(MAKE) run CASE=$(text_case).toml OUT=$(text_case) SEED= ARGS=--quiet && \
	  $(read_with_paraview) $(text_case) $(text_case).toml)

.PHONY: deps
deps:  ## install what running and testing need; nothing when all is there
	$(needs) run test

.PHONY: clean
clean:  ## remove everything built; results in out/ stay
	rm -rf $(BUILD)
