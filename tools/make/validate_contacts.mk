# The published single contacts of cases/VALIDATION.md: the tests that record figures (tests/recorded.hpp), linked into a
# program of their own and run once, in one process.

contact_tests := acceptance_test acceptance_impacts_test published_contacts_test turning_impacts_test rolling_test \
  rolling_impacts_test own_walls_test unequal_impacts_test gross_sliding_test
contact_records := $(build)/validate/contacts.csv

$(build)/validate/contacts_tests: $(call objects,tests/main.cpp tests/recorded.cpp $(contact_tests:%=tests/%.cpp)) $(run_objects)
	@mkdir -p $(@D)
	$(call say,link $@)
	$(quiet)$(CXX) $(link_flags) $^ $(libraries) $(linked)

# Those of the reference by itself and the growth of errors record nothing. A figure that differs (code 1) is shown as such on
# the page; a program that breaks off leaves no record.
$(contact_records): $(build)/validate/contacts_tests
	@mkdir -p $(@D)
	$(call say,run $<)
	$(quiet)rm -f $@.$$$$; FIXDEM_RECORD=$@.$$$$ $< --test-case-exclude='*in the reference*,*error of the restitution grows*' --no-intro --minimal >&2 || \
	  [ $$? = 1 ] || { rm -f $@.$$$$; exit 1; }; mv -f $@.$$$$ $@
