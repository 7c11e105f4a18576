# Benchmarks: `make bench` and what writes its results into bench/README.md. Speed is measured here and nowhere else; no test is
# timed.

# Every folder of a final state that the standard set of benchmarks starts from: bench/main.cpp.
bench_states := pipe_bed settle plug_u24

.PHONY: bench bench-set bench-case
bench:  ## time whole steps and their stages (Google Benchmark), or the steps of CASE alone; FILTER=regex, JSON=file
	$(needs) run bench
	+@$(MAKE) $(if $(case_given),bench-case,bench-set)

bench-set:
	$(files) build-bench
	+@for state in $(bench_states); do $(MAKE) final-state CASE=$$state $(plainly); done
	@$(build)/bench out $(bench_options)

bench-case:
	$(files) $(case_bench)
	+@$(read_start); final=$(usual)/final.fixdem; \
	if [ -e $$final ]; then state="final $$final"; \
	elif [ -n '$(SEED)' ]; then echo "fixdem: there is no $$final: run the case with this SEED first" >&2; exit 3; \
	elif [ -n "$$from" ]; then $(MAKE) final-state CASE="$$from" OUT= ARGS= RESUME= FRESH= EXTEND=; state="start $$start"; \
	else state=start; fi; \
	$(case_bench) $$state $(bench_options)

.PHONY: bench-report
bench_runs := $(foreach n,1 2 3 4 5,$(build)/bench-report-$n.json)
bench-report:  ## run the benchmarks five times (or read JSON=file): table, picture and bench/README.md
	$(needs) run bench report
	+@[ -n '$(JSON)' ] || { set -e; for json in $(bench_runs); do $(MAKE) bench-set JSON=$$json FILTER=; done; }
	tools/bench_report/bench_report.py $(or $(JSON),$(bench_runs)) --reports bench/reports --readme bench/README.md --head README.md

.PHONY: bench-peers
bench-peers:  ## fixdem beside LAMMPS and LIGGGHTS, same scenes, one core; LMP=/path/to/lmp, JSON=file; rewrites the table in bench/README.md and a row in README.md
	$(needs) run peers $(if $(LMP),,lammps)
	$(files) build-peers
	+@$(MAKE) final-state CASE=pipe_bed $(plainly)
	tools/peers/bench_peers.py --programs $(peers)/bin --headers $(peers)/cases --settled out/pipe_bed/final.fixdem \
	  --out out/peers --readme bench/README.md --head README.md $(if $(LMP),--lmp '$(LMP)') $(if $(JSON),--json '$(JSON)')

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
