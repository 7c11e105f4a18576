# `make sweep`: many runs of one case with values that vary (tools/sweep/README.md). The derived cases lie in the sweep's own folder;
# each has a header and a program of its own, by the rules that every case has.

SWEEP ?= cases/sweeps/plug_velocity.toml
ENGINE ?= parallel
HOSTS ?=
SWEEP_SSH ?=
sweep_name := $(basename $(notdir $(SWEEP)))
sweep_out := $(if $(filter command environment,$(origin OUT)),$(OUT),out/sweeps/$(sweep_name))
sweep_build := $(build)/sweeps$(subst /,+,$(abspath $(sweep_out)))
$(eval $(call case_rules,$(sweep_build),$(sweep_out)/cases/))

sweep_options = --out $(sweep_out) --casegen $(casegen) --programs $(sweep_build)/bin --engine '$(ENGINE)' \
  $(if $(filter command environment,$(origin JOBS)),--jobs '$(JOBS)') $(if $(HOSTS),--hosts '$(HOSTS)') $(if $(SWEEP_SSH),--ssh '$(SWEEP_SSH)')
sweep_python = $(call python_with,tomli_w)

.PHONY: build-sweep
build-sweep: $(patsubst $(sweep_out)/cases/%.toml,$(sweep_build)/bin/%,$(wildcard $(sweep_out)/cases/*.toml))

-include $(wildcard $(sweep_build)/cases/*.d)
