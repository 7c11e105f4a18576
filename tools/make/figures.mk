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
line_cases := line_10mm line_blocked line_ramp_up line_ramp_down line_vertical line_incline
figure_scenes := settle heap_rolling heap_sliding settle_two_sizes plug_u24 plug_sizes plug_two_sizes $(line_cases)

.PHONY: build-figures
build-figures: $(figure_impacts) $(figure_decays) $(addprefix $(build)/bin/,$(plug_cases) $(figure_scenes))

.PHONY: plug-table
plug-table:  ## run the five plugs from three seeds of each fill (those not yet run) and rewrite the table in cases/README.md
	$(needs) run table
	$(files) $(addprefix $(build)/bin/,$(plug_cases))
	tools/plug_table/plug_table.py --programs $(build)/bin --out out/plug_table --jobs $(JOBS) cases/README.md

# The base case of the open lines with other seeds of its feed and of its start, each with a program of its own.
line_seeds := 1 2 3
line_table := $(build)/line_table
line_runs := $(line_seeds:%=line_10mm_seed%)
$(line_runs:%=$(line_table)/%.toml): $(line_table)/line_10mm_seed%.toml: cases/line_10mm.toml always
	@mkdir -p $(@D)
	@tools/line_table/with_seed.py $< $* >$@.$$$$; cmp -s $@.$$$$ $@ && rm $@.$$$$ || mv -f $@.$$$$ $@
$(eval $(call case_rules,$(line_table),$(line_table)/))

.PHONY: line-table
line-table:  ## run line_10mm from three seeds of its start and feed (those not yet run) and rewrite the table in cases/README.md
	$(needs) run table
	$(files) $(line_runs:%=$(line_table)/bin/%)
	tools/line_table/line_table.py cases/README.md --cases $(line_table) --programs $(line_table)/bin --out out/line_table --jobs $(JOBS) $(line_runs)

.PHONY: figures
figures:  ## the paper's figures from runs of our own (those not yet made): cases/gallery/ and cases/README.md; JOBS=1: one at a time
	$(needs) run table report picture figures
	$(files) build-figures
	+@for name in $(figure_scenes); do $(MAKE) final-state CASE=$$name $(plainly) || exit; done
	@$(numpy_python) tools/figures/figures.py cases/README.md --out cases/gallery --programs $(build)/bin --impacts $(figure_impacts) \
	  --decays $(figure_decays) --jobs $(JOBS)

-include $(wildcard $(figure_impacts).d $(line_table)/cases/*.d)
