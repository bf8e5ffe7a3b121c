# bench.mk - make bench BENCH='--quick --json FILE'; peers are optional (make deps-bench).

.PHONY: bench bench-fonttools deps-bench pictures libraries-of-pictures

# As their users would compile them. System headers are not ours to warn about.
PEER_FLAGS := -O3 -march=native -DNDEBUG -isystem /usr/include/opencv4 \
              -isystem /usr/include/freetype2
PEER_C     := $(CC) -x c -std=c11 $(STRICT) $(PEER_FLAGS)
PEER_CXX   := $(CXX) -x c++ -Wall -Wextra $(PEER_FLAGS)

BENCH_PARTS    := bench measure table vectors targets polygons kernels order schemes trust streams \
                  batches contest curves paths distance raster_scenes raster_exact raster_race \
                  raster_contest raster_tables raster_filters raster_windows raster_downsample \
                  raster_chart raster chart svg
BENCH_PACKAGES := g++ libgeos-dev libboost-dev libcgal-dev libopencv-imgproc-dev \
                  libfreetype-dev libcairo2-dev libagg-dev libstb-dev fonts-dejavu-core \
                  python3-fonttools python3-sympy
# A peak of multiply-adds and a scalar kernel must stay what they are written as.
BENCH_COMPILE   = $(COMPILE) -std=c11 -fno-tree-vectorize -fno-tree-slp-vectorize \
                  -I$(B)/emitted $(BENCH_EMITS:%=-I$(B)/bench.%)
BENCH_OBJECTS  := $(BENCH_PARTS:%=$(B)/bench.obj/%.o)

# Kernels for comparison, each emission under a prefix of its own: everything as a coefficient
# matrix, all moments to degree 12, and curves with every term written out. The files to compile are
# known only after gen ran.
BENCH_EMITS := mx deg12 ex
EMIT_mx     := --scheme matrix --max-degree 6 --precision double
EMIT_deg12  := --max-degree 12
EMIT_ex     := --scheme expanded --families curves --max-degree 2 --edges quad,cubic \
               --precision double
FILES_mx    := mx_*.c
FILES_deg12 := deg12_moments*.c
FILES_ex    := ex_*.c

$(BENCH_EMITS:%=$(B)/bench.%.stamp): $(B)/bench.%.stamp: $(B)/gen
	$(B)/gen $(EMIT_$*) --prefix $* --no-runtime --quiet --out $(B)/bench.$*
	@touch $@

$(B)/bench.%/kernels.a: $(B)/bench.%.stamp
	@cd $(@D) && rm -f $(@F) *.o && for f in $(FILES_$*); do \
		$(COMPILE) -std=c99 -c -o "$${f%.c}.o" "$$f" || exit 1; done && \
		ar rcs $(@F) *.o

$(B)/bench.obj:
	@mkdir -p $@

$(B)/bench.obj/%.o: bench/%.c bench/bench.h bench/peers.h bench/raster.h bench/svg.h \
		bench/vector_template.h \
		$(B)/emitted.stamp $(BENCH_EMITS:%=$(B)/bench.%.stamp) | $(B)/bench.obj
	$(BENCH_COMPILE) -c -o $@ $<

# Vectorised, unlike the rest, as the peers are.
$(B)/bench.obj/raster_downsample.o: BENCH_COMPILE = $(PEER_C) -ffp-contract=fast -I$(B)/emitted

# name, file, compiler, its header, what to link: compiled if the header is there.
define peer_rule
BENCH_PEERS += $(B)/bench.obj/peer_$1
$(B)/bench.obj/peer_$1.o: bench/$2 bench/peer_absent.c bench/peers.h | $(B)/bench.obj
	@if echo '#include <$4>' | $3 -fsyntax-only - 2>/dev/null; then \
		echo '$5' >$$(@:.o=.link); \
		echo '$3 -c -o $$@ $$<'; $3 -c -o $$@ $$<; \
	else \
		: >$$(@:.o=.link); \
		$(CC) -DPEER=$1 -c -o $$@ bench/peer_absent.c; \
	fi
endef
$(eval $(call peer_rule,GEOS,peer_geos.c,$(PEER_C),geos_c.h,-lgeos_c))
$(eval $(call peer_rule,Boost,peer_boost.cpp,$(PEER_CXX),boost/geometry.hpp,-lstdc++))
$(eval $(call peer_rule,CGAL,peer_cgal.cpp,$(PEER_CXX),CGAL/Polygon_2.h,-lstdc++ -lmpfr -lgmp))
$(eval $(call peer_rule,OpenCV,peer_opencv.cpp,$(PEER_CXX),opencv2/imgproc.hpp,-lopencv_imgproc \
	-lopencv_core -lstdc++))
$(eval $(call peer_rule,FreeType,peer_freetype.c,$(PEER_C),ft2build.h,-lfreetype))
$(eval $(call peer_rule,cairo,peer_cairo.c,$(PEER_C),cairo/cairo.h,-lcairo))
$(eval $(call peer_rule,AGG,peer_agg.cpp,$(PEER_CXX),agg2/agg_basics.h,-lagg -lstdc++))
$(eval $(call peer_rule,stb,peer_stb.c,$(PEER_C),stb/stb_truetype.h,))

$(B)/bench: $(BENCH_OBJECTS) $(BENCH_PEERS:=.o) $(BENCH_EMITS:%=$(B)/bench.%/kernels.a) $(LIB)
	$(COMPILE) -o $@ $^ $(LDFLAGS) $$(cat $(BENCH_PEERS:=.link)) -lm

bench: $(B)/bench
	@$(B)/bench $(BENCH)

# A minute, most of it SymPy's; a python3 that has both may not be the first one.
bench-fonttools: $(B)/gen
	@for python in python3 /usr/bin/python3; do \
		if $$python -c 'import fontTools, sympy' 2>/dev/null; then \
			exec $$python bench/peer_fonttools.py $(B)/gen $(BENCH); \
		fi; \
	done; \
	echo 'skip fontTools: it, or SymPy, is not installed (make deps-bench)'

$(B)/origin: bench/origin.c bench/svg.c bench/svg.h $(LIB)
	$(COMPILE) -std=c11 -I$(B)/emitted -o $@ $(filter %.c,$^) $(LIB) $(LDFLAGS) -lm

# The first ones need nothing, those below them FreeType and libpng. Speeds are this machine's.
pictures: $(B)/origin $(B)/bench plots
	$(B)/origin bench/origin.svg
	$(B)/bench --only kernels --svg bench/slots.svg
	@$(MAKE) --no-print-directory libraries-of-pictures
	$(B)/bench --only raster --svg-raster bench/raster.svg
	@$(MAKE) --no-print-directory sheet

libraries-of-pictures:
	@if ! $(HAS_RENDER_LIBRARIES); then \
		echo 'bench/raster.svg and examples/render/sheet.png need FreeType and libpng:' \
			'make deps deps-bench'; \
		exit 1; \
	fi

deps-bench:
	@$(MAKE) --no-print-directory deps PACKAGES='$(BENCH_PACKAGES)'
	@rm -f $(BENCH_PEERS:=.o)
