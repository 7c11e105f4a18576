# Pictures and movies of runs, and ParaView: as a renderer, and as a reader that the frames are tried on.

.PHONY: pictures
pictures:  ## run plug_u24 and redraw the picture of the README (cases/gallery/)
	$(needs) run picture
	@$(MAKE) run CASE=plug_u24 OUT=out/picture ARGS='--quiet'
	tools/picture/picture.py out/picture cases/gallery/plug_u24 --case cases/plug_u24.toml

.PHONY: movie
movie:  ## a movie of the last run of CASE, or of a run made now: OUT/movie.mp4, or FORMAT=gif; SECONDS=10 long
	$(needs) run movie
	$(files) build-program
	+@[ -e $(OUT)/summary.json ] || $(MAKE) run
	@$(numpy_python) tools/movie/movie.py $(OUT) $(OUT)/movie.$(or $(FORMAT),mp4) --case $(case_file) --seconds $(or $(SECONDS),10)

.PHONY: test-movie
test-movie:  ## a short movie of settle: its pictures, and that it plays
	$(needs) run movie
	+@$(MAKE) final-state CASE=settle OUT= SEED= ARGS=
	@$(numpy_python) tests/movie_test.py out/settle $(build)/scratch

.PHONY: render
render:  ## render CASE's frames with ParaView into OUT/render.png
	$(needs) render
	xvfb-run -a pvpython --force-offscreen-rendering tools/picture/render_paraview.py $(OUT) $(OUT)/render.png

.PHONY: test-paraview
read_with_paraview = pvpython --force-offscreen-rendering tests/paraview_test.py
text_case := $(build)/scratch/settle_as_text
test-paraview:  ## the frames of settle, binary and as text, or of CASE read back by ParaView's own reader
	$(needs) run render
	+@$(MAKE) final-state CASE=$(if $(case_given),$(case_file),settle) OUT= SEED= ARGS=
	@$(read_with_paraview) out/$(if $(case_given),$(case_name),settle) $(if $(case_given),$(case_file),cases/settle.toml)
	@$(if $(case_given),,mkdir -p $(build)/scratch; sed '/^frame_interval/a frame_data = "text"' cases/settle.toml >$(text_case).toml)
	+@$(if $(case_given),,$(MAKE) run CASE=$(text_case).toml OUT=$(text_case) SEED= ARGS=--quiet && \
	  $(read_with_paraview) $(text_case) $(text_case).toml)
