# Error against run time (make frontier): the programs it is measured with, and the trajectory it is measured against.
#
# A curve of the report is INTEGRATOR.SLIDER.PRECISION, one line each here; each is compiled twice, for single impacts
# (collide) and for the whole scene (bodies), over a list of time steps in thousandths of the case's own.
# QUICK=1 takes fewer of everything, and less optimisation, to see that all of it works.

frontier_curves := euler.clip.double
frontier_curves += euler.clip.mixed
frontier_curves += leapfrog.clip.double
frontier_curves += leapfrog.clip.mixed
frontier_curves += impulse.exact.double
frontier_curves += impulse.exact.mixed

# Beside the curves, for single impacts: the other tangential laws (INTEGRATOR.SLIDER.PRECISION.LAW), and the slider that
# does not converge.
frontier_laws := $(foreach i,euler leapfrog,$i.clip.double.force $i.clip.double.rescale $i.paper.double)
frontier_steps_of_impacts := 10,100,500,1000,2000,5000,10000,20000
frontier_steps_of_laws := 10,100,1000,5000
frontier_steps_of_bodies := 1000,2000,5000,10000
frontier_gas_intervals := 200,5000,20000  # thousandths of the case's interval, at the case's time step

# Equations (10) to (12) to the letter know no other limit of friction than the whole force.
frontier_limit := $(shell grep -qs '^ *friction_limit *= *"elastic"' $(case_file) && echo elastic)

frontier := $(case_build)/frontier/$(case_name)$(if $(QUICK),-quick)
ifdef QUICK
frontier_curves := euler.clip.double leapfrog.clip.double
frontier_laws := euler.paper.double
frontier_steps_of_impacts := 100,1000,5000
frontier_steps_of_laws := 100,1000,5000
frontier_steps_of_bodies := 1000,5000
frontier_bodies_flags := -Og
else
frontier_bodies_flags := -O3
endif

ifneq ($(frontier_limit),)
frontier_laws := $(filter-out %.paper.double,$(frontier_laws))
endif

frontier_gas := $(if $(QUICK),,$(shell grep -qs '^ *\[gas\]' $(case_file) && echo gas.euler.clip.double))
frontier_programs := $(frontier)/exact $(frontier_curves:%=$(frontier)/bodies.%) $(frontier_gas:%=$(frontier)/bodies.%) \
  $(frontier_curves:%=$(frontier)/collide.%) $(frontier_laws:%=$(frontier)/collide.%)
# The settled or moving scene that trajectories start from; a quick run has one of its own.
frontier_state := $(if $(QUICK),$(frontier)/run,out/$(run_name))/final.fixdem
ifdef QUICK
$(frontier_state): $(case_program)
	$(quiet)$(read_start); $(case_program) --out $(@D) --replace --quiet --no-frames $${start:+--start-state "$$start"}
endif

comma := ,
frontier_word = $(word $(1),$(subst ., ,$(2)))
frontier_choice = $(addprefix -DFIXDEM_INTEGRATOR=,$(call frontier_word,1,$(1))) $(addprefix -DFIXDEM_SLIDER=,$(call frontier_word,2,$(1))) \
  $(addprefix -DFIXDEM_PRECISION=,$(call frontier_word,3,$(1))) $(addprefix -DFIXDEM_TANGENTIAL=,$(call frontier_word,4,$(1)))
# $(1): level of optimisation; $(2): what else
frontier_compile = $(quiet)mkdir -p $(frontier)/notes; $(CXX) -I$(case_build) $(filter-out -O%,$(program_flags)) \
  $(1) $(2) $(call program_defines,$$($(casegen) --name $(case_file)),$(case_name))

.PHONY: build-frontier
# The truth first: it takes longest, and the rest is compiled meanwhile (make comes to it first only if its program is there).
build-frontier: $(frontier)/truth.csv $(frontier_programs)

$(frontier)/truth: tools/frontier/truth.cpp $(case_header) $(run_objects)
	$(call say,compile $<)
	$(call frontier_compile,$(if $(QUICK),-O2,-O3),$(if $(QUICK),-DFIXDEM_FINER=8)) $< $(run_objects) $(libraries) $(call kept,$(frontier)/notes/$(@F).d)

# The state of now, whatever its time stamp says.
$(frontier)/state.fixdem: $(frontier_state) always
	@mkdir -p $(@D); cmp -s $< $@ || cp $< $@

$(frontier)/truth.csv: $(frontier)/truth $(frontier)/state.fixdem
	$(call say,trajectory of the reference in extended precision (some minutes for a thousand particles))
	$(quiet)$< $(frontier)/state.fixdem > $@.$$$$; mv -f $@.$$$$ $@

$(frontier)/exact: tools/frontier/exact.cpp $(case_header)
	$(call say,compile $<)
	$(call frontier_compile,-O1) $< $(libraries) $(call kept,$(frontier)/notes/$(@F).d)

$(frontier)/bodies.gas.%: tools/frontier/bodies.cpp $(case_header) $(run_objects)
	$(call say,compile $< for $* and other intervals of the gas)
	$(call frontier_compile,$(frontier_bodies_flags),$(call frontier_choice,$*) -DFIXDEM_FACTORS=1000 \
	  -DFIXDEM_GAS_FACTORS=$(frontier_gas_intervals)) $< $(run_objects) $(libraries) $(call kept,$(frontier)/notes/$(@F).d)

$(frontier)/bodies.%: tools/frontier/bodies.cpp $(case_header) $(run_objects)
	$(call say,compile $< for $*)
	$(call frontier_compile,$(frontier_bodies_flags),$(call frontier_choice,$*) -DFIXDEM_FACTORS=$(frontier_steps_of_bodies)) \
	  $< $(run_objects) $(libraries) $(call kept,$(frontier)/notes/$(@F).d)

$(frontier)/collide.%: tools/frontier/collide.cpp $(case_header)
	$(call say,compile $< for $*)
	$(call frontier_compile,-Og,$(call frontier_choice,$*) -DFIXDEM_FACTORS=$(if \
	  $(filter $*,$(frontier_laws)),$(frontier_steps_of_laws),$(frontier_steps_of_impacts))) $< $(libraries) $(call kept,$(frontier)/notes/$(@F).d)

.PHONY: frontier
frontier:  ## error against run time for CASE: bench/reports/CASE/frontier.md; QUICK=1: a part, to try it out
	$(needs) run frontier
	$(files) build-program
	+@$(MAKE) final-state $(plainly)
	$(files) $(frontier)/truth
	$(files) build-frontier
	+@$(read_start); [ -z "$$from" ] || $(MAKE) build-program CASE="$$from"
	+@$(read_start); fill=$${from:+$$($(MAKE) print-program CASE="$$from")}; tools/frontier/frontier.py --programs $(frontier) --case $(case_name) --header $(case_header) \
	  --state $(frontier_state) $${fill:+--fill "$$fill"} $(if $(QUICK),--quick) \
	  --out $(if $(QUICK),$(frontier)/report,bench/reports/$(run_name))

-include $(wildcard $(frontier)/notes/*.d)
