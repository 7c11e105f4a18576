# `make figures`: the paper's figures, from programs and runs of their own. Runs are kept in out/ and shared with make plug-table.

# Time steps of Fig. 8, s.
figure_steps := 5e-07 2e-06 1e-05 2e-05 3e-05 3.5e-05 4e-05
figure_decays := $(figure_steps:%=$(build)/stability/settle/bin/kernel_runs+TIME_STEP@%)
figure_impacts := $(build)/figures/impacts
# How many plugs run at a time.
JOBS ?= 2

$(figure_impacts): tools/figures/impacts.cpp $(build)/cases/collide_wall.hpp
	@mkdir -p $(@D)
	$(call say,compile $<)
	$(quiet)$(CXX) $(tool_flags) $(link_flags) $< $(libraries) $(call kept,$@.d)

# Whose runs are shown as they are.
figure_scenes := settle heap_rolling heap_sliding settle_two_sizes plug_u24 plug_sizes plug_two_sizes

.PHONY: build-figures
build-figures: $(figure_impacts) $(figure_decays) $(addprefix $(build)/bin/,$(plug_cases) $(figure_scenes))

.PHONY: plug-table
plug-table:  ## run the five plugs from three seeds of each fill (those not yet run) and rewrite the table in cases/README.md
	$(needs) run table
	$(files) $(addprefix $(build)/bin/,$(plug_cases))
	tools/plug_table/plug_table.py --programs $(build)/bin --out out/plug_table --jobs $(JOBS) cases/README.md

.PHONY: figures
figures:  ## the paper's figures from runs of our own (those not yet made): cases/gallery/ and cases/README.md; JOBS=1: one at a time
	$(needs) run table report picture figures
	$(files) build-figures
	+@for name in $(figure_scenes); do $(MAKE) final-state CASE=$$name $(plainly) || exit; done
	@$(numpy_python) tools/figures/figures.py cases/README.md --out cases/gallery --programs $(build)/bin --impacts $(figure_impacts) \
	  --decays $(figure_decays) --jobs $(JOBS)

-include $(wildcard $(figure_impacts).d)
