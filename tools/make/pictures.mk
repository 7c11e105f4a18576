# Pictures and movies of runs, and ParaView: as a renderer, and as a reader that the frames are tried on.

.PHONY: pictures
pictures:  ## run plug_u24 and redraw the picture of the README (cases/gallery/)
	$(needs) run picture
	@$(MAKE) run CASE=plug_u24 $(plainly) OUT=out/picture ARGS=--quiet FRESH=1
	tools/picture/picture.py out/picture cases/gallery/plug_u24 --case cases/plug_u24.toml

.PHONY: movie
movie:  ## a movie of the last run of CASE, or of a run made now: OUT/movie.mp4, or FORMAT=gif; SECONDS=10 long
	$(needs) run movie
	$(files) build-program
	+@[ -e $(out)/summary.json ] || $(MAKE) run
	@$(numpy_python) tools/movie/movie.py $(out) $(out)/movie.$(or $(FORMAT),mp4) --case $(case_file) --seconds $(or $(SECONDS),10)

.PHONY: test-movie
test-movie:  ## a short movie of settle: its pictures, and that it plays
	$(needs) run movie
	+@$(MAKE) final-state CASE=settle $(plainly)
	@$(numpy_python) tests/movie_test.py out/settle $(build)/scratch

.PHONY: render
render:  ## render CASE's frames with ParaView into OUT/render.png
	$(needs) render
	xvfb-run -a pvpython --force-offscreen-rendering tools/picture/render_paraview.py $(out) $(out)/render.png

.PHONY: test-paraview
read_with_paraview = pvpython --force-offscreen-rendering tests/paraview_test.py
text_case := $(build)/scratch/settle_as_text
test-paraview:  ## the frames of settle, binary and as text, or of CASE read back by ParaView's own reader
	$(needs) run render
	+@$(MAKE) final-state CASE=$(if $(case_given),$(case_file),settle) $(plainly)
	@$(read_with_paraview) out/$(if $(case_given),$(run_name),settle) $(if $(case_given),$(case_file),cases/settle.toml)
	@$(if $(case_given),,rm -rf $(text_case); mkdir -p $(build)/scratch; sed '/^frame_interval/a frame_data = "text"' cases/settle.toml >$(text_case).toml)
	+@$(if $(case_given),,$(MAKE) run CASE=$(text_case).toml $(plainly) OUT=$(text_case) ARGS=--quiet && \
	  $(read_with_paraview) $(text_case) $(text_case).toml)
