# What a scene costs: `make footprint`. Programs are compiled as those of cases are, but for AVX2 also on a machine with
# more, because callgrind knows no more.

footprint := $(build)/footprint
footprint_flags := -std=c++20 $(warnings) -I$(build) -I. -O3 $(call arch_of,$(if $(is_x86),x86-64-v3,native)) $(math_rules)

$(footprint)/strips: tools/footprint/strips.cpp tools/make/footprint.mk $(build)/cases/plug_u24.hpp
	@mkdir -p $(@D)
	$(call say,compile $<)
	$(quiet)$(CXX) $(footprint_flags) $< $(call kept,$@.d)

# The start state of a case: embedded.mk, one case at a time.
$(footprint)/cases/$(run_name): tools/footprint/one_case.cpp tools/make/footprint.mk $(embedded)/start.hpp
	@mkdir -p $(@D)
	$(call say,compile $< for $(case_name))
	$(quiet)$(CXX) $(footprint_flags) $(case_defines) -DFIXDEM_START_HEADER='"embedded/$(case_name)/start.hpp"' \
	  $< $(call kept,$@.d)

.PHONY: build-footprint
build-footprint: $(footprint)/strips $(footprint)/cases/$(run_name)

.PHONY: footprint
footprint:  ## memory, code, instructions and cycles of every case and of a scene stripped step by step: kernel/README.md
	$(needs) run footprint
	+@for case in $(case_names); do $(MAKE) case-start CASE=$$case; $(MAKE) build-footprint CASE=$$case; done
	@tools/footprint/footprint.py --strips $(footprint)/strips --programs $(footprint)/cases --headers $(build)/cases \
	  --readme kernel/README.md $(case_names)

-include $(wildcard $(footprint)/*.d $(footprint)/cases/*.d)
