# Programs of `make stability`, compiled for CASE: $(stability)/bin/SOURCE[+NAME@VALUE...], each NAME@VALUE a -DFIXDEM_NAME=VALUE.
# Those that step the kernel for long are compiled like programs, the others as quickly as possible.

stability := $(case_build)/stability/$(case_name)
stability_objects := $(call objects,tools/stability/tangent.cpp tools/stability/rules_of_thumb.cpp)
stability_source = $(firstword $(subst +, ,$(1)))
stability_defines = $(patsubst %,-DFIXDEM_%,$(subst @,=,$(wordlist 2,99,$(subst +, ,$(1)))))
stability_flags = $(if $(filter kernel_runs+TIME_STEP%,$(1)),$(program_flags),$(if $(filter limits,$(1)),$(common) -O2 $(kernel_math),$(tool_flags)))

# $(1): folder of the build, $(2): folder of the file, $(3): name of the case.
define stability_rules
$(1)/stability/$(3)/bin/%: $(1)/cases/$(3).hpp $(run_objects) $(stability_objects) tools/make/stability.mk
	@mkdir -p $$(@D)
	$$(call say,compile tools/stability/$$* for $(3))
	$$(quiet)$$(CXX) -I$(1) $$(call stability_flags,$$*) $(link_flags) \
	  $$(call program_defines,$$$$($(casegen) --name $(2)$(3).toml),$(3)) $$(call stability_defines,$$*) \
	  tools/stability/$$(call stability_source,$$*).cpp $(run_objects) $(stability_objects) $(libraries) $$(call kept,$(1)/stability/$(3)/$$*.d)
endef
$(eval $(call stability_rules,$(case_build),$(case_folder),$(case_name)))
stability_quick := $(addprefix $(build)/stability/settle/bin/,kernel_runs+RESTITUTION@0.2+STILL@1 limits extremes_load)
$(if $(filter settle,$(run_name)),,$(eval $(call stability_rules,$(build),cases/,settle)))

# The part that belongs to make test (tests/run.sh).
build-tests: $(stability_quick)

.PHONY: stability
stability_out = $(if $(QUICK),$(stability)/page,bench/reports/$(run_name))
stability:  ## how far CASE is from instability: page, tables and pictures in bench/reports/CASE; QUICK=1 is the part of it in make test
	$(needs) run test $(if $(QUICK),,report)
	+@$(MAKE) final-state CASE='$(case_file)' $(plainly)
	+tools/stability/stability.py --case-file $(case_file) --casegen $(casegen) --folder $(stability) --results $(usual) \
	  --make '$(MAKE) $(parallel) CASE=$(case_file)' --out $(stability_out) $(if $(QUICK),--quick)

-include $(wildcard $(build)/stability/*/*.d $(case_build)/stability/*/*.d)
