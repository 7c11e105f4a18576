# `make validate`: everything outside that has numbers, beside this program; the page cases/VALIDATION.md. Derived cases lie beside
# the runs; each has a header and a program of its own, by the rules that every case has.

validate_out := out/validate
validate_build := $(build)/validate
$(eval $(call case_rules,$(validate_build),$(validate_out)/cases/))

.PHONY: validate
validate:  ## hold results against the paper, slug laws, a peer's slug: cases/VALIDATION.md; ROW=section/name or SECTION=name alone; KEPT=1 runs nothing
	$(needs) run report
	$(files) $(casegen)
	+@tools/validate/validate.py cases/VALIDATION.md --build $(build) --out $(validate_out) --jobs $(JOBS) --make '$(MAKE) $(parallel)' \
	  $(if $(ROW),--row '$(ROW)') $(if $(SECTION),--section '$(SECTION)') $(if $(KEPT),--kept)

-include $(wildcard $(validate_build)/cases/*.d)
