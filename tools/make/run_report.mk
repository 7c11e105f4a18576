# `make report`: the page of a run. Its script and style are bundled once from tools/run_report/source and npm packages
# (versions pinned in tools/run_report/package-lock.json, all for Node.js 18 and later); node_modules lies in BUILD/node,
# whatever the compiler.

page_folder := $(BUILD)/node
page_bundle := $(page_folder)/page
page_sources := $(wildcard tools/run_report/source/*.js tools/run_report/source/*.css)
npm := npm --prefix $(page_folder) --no-audit --no-fund --ignore-scripts --loglevel=error

# What tests need, once it is there, stays.
with_tests = $(if $(findstring tests,$(1)),$(1),$(wildcard $(page_folder)/installed-for-tests))
$(page_folder)/installed $(page_folder)/installed-for-tests: tools/run_report/package-lock.json
	@mkdir -p $(page_folder)
	$(call say,fetch the npm packages that the page is made with)
	$(quiet)cp tools/run_report/package.json tools/run_report/package-lock.json tools/run_report/.npmrc $(page_folder)
	$(quiet)$(npm) ci $(if $(call with_tests,$@),,--omit=dev) >&2
	@touch $(page_folder)/installed $(call with_tests,$@)

$(page_bundle)/page.js: $(page_sources) tools/run_report/package-lock.json | $(page_folder)/installed
	$(call say,bundle the page)
	$(quiet)rm -rf $(page_folder)/source && cp -r tools/run_report/source $(page_folder)/source
	$(quiet)$(page_folder)/node_modules/.bin/esbuild $(page_folder)/source/main.js --bundle --minify --format=esm --charset=utf8 \
	  --target=es2022 --legal-comments=eof --log-level=warning --outfile=$@

# The python3 that has a module: the first of the path, or else the system's own, which packages bring it to.
python_with = $$(python3 -c 'import $(1)' 2>/dev/null && echo python3 || echo /usr/bin/python3)
numpy_python = $(call python_with,numpy)

.PHONY: build-page
build-page: $(page_bundle)/page.js

.PHONY: report
report:  ## a page about the last run of CASE, or about a run made now: OUT/report.html, opens in any browser
	$(needs) run page
	$(files) build-program build-page
	+@[ -e $(out)/summary.json ] || $(MAKE) run
	@$(numpy_python) tools/run_report/run_report.py $(out) $(out)/report.html --case $(case_file) --program $(case_program) --bundle $(page_bundle)

.PHONY: test-report
test-report:  ## the page of settle (or CASE) in a headless browser; PICTURES=folder keeps what it looked like
	$(needs) run page browser
	$(files) $(page_folder)/installed-for-tests
	+@$(MAKE) report CASE=$(if $(case_given),$(case_file),settle)
	@$(if $(PICTURES),mkdir -p $(PICTURES);) results=$(or $(OUT),out/$(if $(case_given),$(run_name),settle)$(if $(SEED),-seed$(SEED))); $(numpy_python) tests/run_report/run_report_test.py \
	  $$results $$results/report.html $(if $(case_given),$(case_file),cases/settle.toml) $(page_folder) "$$(command -v chromium)" $(PICTURES)
