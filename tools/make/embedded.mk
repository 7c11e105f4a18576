# Programs without operating system, and the last bit of one case everywhere: `make embedded` and `make identical CASE=..`.
#
# tools/embedded/main.cpp is compiled for each instruction set that `make identical` compares (rules.mk), with the start
# state of the case as a generated header; `cortex-m7` is the bare board, emulated by QEMU. No library is linked there but
# the compiler's own (division of 64-bit numbers).

board_compiler := arm-none-eabi-g++
board_script := tools/embedded/mps2_an500.ld
board_flags := -mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16 -ffreestanding -fno-exceptions -fno-rtti \
  -fno-unwind-tables -fno-use-cxa-atexit -fno-threadsafe-statics -ffunction-sections -fdata-sections -Wno-psabi
board_link := -nostdlib -nostartfiles -T $(board_script) -Wl,--gc-sections,--fatal-warnings,--print-memory-usage
startup := $(build)/embedded/startup.o

$(startup): tools/embedded/startup.cpp tools/embedded/console.hpp tools/make/embedded.mk
	@mkdir -p $(@D)
	$(call say,compile $<)
	$(quiet)$(board_compiler) -std=c++20 $(warnings) -I. -O2 -fno-tree-loop-distribute-patterns $(board_flags) -c $< $(call kept,$@.d)

$(build)/identical/cortex-m7: $(startup) $(board_script)

# How a program is compiled as variant $(1), up to the sources: compiler, optimisation, architecture, lanes. An instruction set
# other than this machine's is compiled with -O1, the board with -O2; `optimised` (rules.mk) are for this machine's.
level_of = -$(or $(patsubst clang-%,%,$(filter $(optimised),$(1))),$(if $(filter native,$(1)),O3,O1))
variant_compiler = $(if $(filter cortex-m7,$(1)),$(board_compiler) $(board_flags) -O2,$(if $(filter aarch64,$(1)),$(cross_compiler) \
  -static,$(if $(filter clang-%,$(1)),clang++,$(CXX))) $(level_of) $(call arch_of,$(if $(filter $(optimised),$(1)),native,$(1))) \
  $(call lanes_of,$(patsubst lanes%,%,$(filter lanes%,$(1:scalar=lanes1))))) -std=c++20 \
  $(if $(filter clang-%,$(1)),$(filter-out $(undefined_registers),$(warnings)),$(warnings)) -I. $(math_rules)
# What is linked to it, and what the linker says about the board's memory.
variant_link = $(if $(filter cortex-m7,$(1)),$(board_link) $(startup) -lgcc > $(2).memory)

embedded := $(case_build)/embedded/$(case_name)
case_defines = $(call program_defines,$$($(casegen) --name $(case_file)),$(case_name))

# The start state of the case, which is written each time and left alone when it is the same.
$(embedded)/make_start: tools/embedded/start_state.cpp $(case_header) $(run_objects)
	@mkdir -p $(@D)
	$(call say,compile $< for $(case_file))
	$(quiet)$(CXX) -I$(case_build) $(tool_flags) $(link_flags) $(case_defines) $< $(run_objects) $(libraries) $(call kept,$@.d)

$(embedded)/start.hpp: $(embedded)/make_start always
	$(quiet)$(read_start); $< $$start > $@.$$$$; if cmp -s $@.$$$$ $@; then rm $@.$$$$; else mv -f $@.$$$$ $@; fi

$(identical_all:%=$(embedded)/%): $(embedded)/%: tools/embedded/main.cpp tools/make/embedded.mk \
  $(embedded)/start.hpp $(board_script) $(if $(filter cortex-m7,$(identical_all)),$(startup))
	$(call say,compile $(case_name) for $*)
	$(quiet)$(call variant_compiler,$*) -I$(case_build) $(case_defines) -DFIXDEM_START_HEADER='"embedded/$(case_name)/start.hpp"' \
	  $< $(call variant_link,$*,$@) $(call kept,$@.d)

.PHONY: build-embedded build-identical-case case-start
build-embedded: $(embedded)/cortex-m7
build-identical-case: $(identical_all:%=$(embedded)/%)
# The final state that the case starts from, if it does.
case-start: $(case_header)
	+@$(read_start); if [ -n "$$from" ]; then $(MAKE) final-state CASE="$$from" OUT= ARGS= RESUME= FRESH= EXTEND=; fi

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

-include $(wildcard $(embedded)/*.d)
