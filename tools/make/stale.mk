# Before make looks at any time stamp: forget what was made of other contents (forget_stale.sh). Once for each folder of a
# build, however many makes call one another.

in_single_quotes = '$(subst ','\'',$(1))'
ifneq ($(filter-out help clean format deps,$(or $(MAKECMDGOALS),help)),)
ifeq ($(findstring |$(CURDIR)/$(build)|,$(FIXDEM_LOOKED_AT)),)
looked_at := $(shell COMPILER='$(CXX)' FLAGS=$(call in_single_quotes,$(program_flags)) LIBRARIES='$(link_flags) $(libraries) $(bench_libraries)' \
  TEST_FLAGS=$(call in_single_quotes,$(test_flags) $(test_defines)) tools/make/forget_stale.sh '$(BUILD)' '$(build)')
ifneq ($(.SHELLSTATUS),0)
$(call refuse,the folder $(BUILD) cannot be written (see above))
endif
export FIXDEM_LOOKED_AT := $(FIXDEM_LOOKED_AT)$(if $(looked_at),|$(CURDIR)/$(build)|)
endif
endif
