# Fuzzers (make fuzz TIME=60): each target of tests/fuzz/ under clang's libFuzzer with the address and the
# undefined-behaviour sanitizer, from the inputs in tests/corpus/ and, for cases, from every case file there is.
# An input that does harm is kept in build/fuzz/TARGET/; once mended, it goes to tests/corpus/ under the name of the harm.

fuzz := $(BUILD)/fuzz
fuzz_targets := case state checkpoint particles
fuzz_compiler := clang++
fuzz_sanitizers := -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all
fuzz_flags := $(filter-out $(collect_later) $(undefined_registers),$(common)) -O1 -g1 $(kernel_math) -Wno-sign-conversion -Wno-bitwise-instead-of-logical $(fuzz_sanitizers)
fuzz_sources_case := $(filter-out tools/casegen/main.cpp,$(wildcard tools/casegen/*.cpp))
fuzz_sources_state := $(filter-out tools/run/main.cpp,$(wildcard tools/run/*.cpp))
fuzz_sources_checkpoint := $(fuzz_sources_state)
fuzz_sources_particles :=
fuzz_object = $(fuzz)/objects/tests/fuzz/$(patsubst checkpoint,state,$(1))_target.o

.PHONY: build-fuzz
build-fuzz: $(fuzz_targets:%=$(fuzz)/bin/%)

$(fuzz)/objects/%.o: %.cpp tools/make/fuzz.mk | $(build)/cases/plug_u24.hpp
	@mkdir -p $(@D)
	$(call say,compile $< for the fuzzers)
	$(quiet)$(fuzz_compiler) $(fuzz_flags) $(object)

define fuzz_rule
$(fuzz)/bin/$(1): tests/fuzz/entry.cpp $(call fuzz_object,$(1)) $(fuzz_sources_$(1):%.cpp=$(fuzz)/objects/%.o)
	@mkdir -p $$(@D)
	$$(call say,link the fuzzer of $(1))
	$$(quiet)$(fuzz_compiler) $(fuzz_flags) -DFIXDEM_FUZZ_TARGET=fuzz_$(1) $$^ $(libraries) $$(linked)
endef
$(foreach t,$(fuzz_targets),$(eval $(call fuzz_rule,$t)))

.PHONY: fuzz
fuzz:  ## throw hostile cases, state files and particles at the readers and the kernel for TIME seconds in all
	$(needs) run test fuzz
	$(files) build-fuzz
	@tests/fuzz/run.sh $(fuzz) $(or $(TIME),60) $(fuzz_targets)

-include $(shell find $(fuzz)/objects -name '*.d' 2>/dev/null)
