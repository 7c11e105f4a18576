# `make validate`: everything outside that has numbers, beside this program; the page cases/VALIDATION.md. Derived cases lie beside
# the runs; each has a header and a program of its own, by the rules that every case has.

validate_out := out/validate
validate_build := $(build)/validate
$(eval $(call case_rules,$(validate_build),$(validate_out)/cases/))

# Single contacts are recorded by tests; the quick form has one short run, and a page of its own.
with_contacts = $(if $(KEPT)$(QUICK),,$(filter contacts contacts/%,$(or $(ROW),$(SECTION),contacts)))
validate_quick := $(build)/validate/quick
validate_page = $(if $(QUICK),$(validate_quick)/VALIDATION.md --results $(validate_quick) --quick --no-pictures,cases/VALIDATION.md --results cases/validation)

.PHONY: validate
validate:  ## hold results against the paper, slug laws, a peer's slug, published contacts: cases/VALIDATION.md; ROW=section/name or SECTION=name alone; KEPT=1 runs nothing; QUICK=1 one short run
	$(needs) run report picture $(if $(with_contacts),test)
	$(files) $(casegen) $(if $(with_contacts),$(contact_records))
	+@$(if $(QUICK),rm -rf $(validate_quick);) tools/validate/validate.py $(validate_page) --build $(build) --out $(validate_out) --jobs $(JOBS) --make '$(MAKE) $(parallel)' \
	  $(if $(ROW),--row '$(ROW)') $(if $(SECTION),--section '$(SECTION)') $(if $(KEPT),--kept) $(if $(with_contacts),--contacts $(contact_records))

-include $(wildcard $(validate_build)/cases/*.d)
