# `make sweep`: many runs of one case with values that vary (tools/sweep/README.md). The derived cases lie in the sweep's own folder;
# each has a header and a program of its own, by the rules that every case has.

SWEEP ?= cases/sweeps/plug_velocity.toml
ENGINE ?= parallel
sweep_name := $(basename $(notdir $(SWEEP)))
sweep_out := $(or $(OUT),out/sweeps/$(if $(filter cases/sweeps/$(sweep_name).toml,$(SWEEP)),$(sweep_name),$(shell tools/make/name_apart.sh $(SWEEP) cases/sweeps)))
sweep_build := $(build)/sweeps/$(if $(filter sweep% build-sweep,$(MAKECMDGOALS)),$(shell tools/make/name_apart.sh $(sweep_out)),none)
$(eval $(call case_rules,$(sweep_build),$(sweep_out)/cases/))

sweep_options = --out $(sweep_out) --casegen $(casegen) --programs $(sweep_build)/bin --engine '$(ENGINE)' \
  $(if $(call from_user,JOBS),--jobs '$(JOBS)') $(if $(HOSTS),--hosts '$(HOSTS)') $(if $(SWEEP_SSH),--ssh '$(SWEEP_SSH)')
sweep_python = $(call python_with,tomli_w)

.PHONY: build-sweep
build-sweep: $(patsubst $(sweep_out)/cases/%.toml,$(sweep_build)/bin/%,$(wildcard $(sweep_out)/cases/*.toml))

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

-include $(wildcard $(sweep_build)/cases/*.d)
