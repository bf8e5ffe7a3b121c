# Edgewise. Targets:
#   make             build gen, emit, build build/libedgewise.a, run examples/shapes on real data
#   make deps        install what the tests need (Debian: apt-get)
#   make test        all tests            make bench       against machine and peers
#   make bench-fonttools                  beside fontTools' symfont and MomentsPen
#   make cutcell     examples/cutcell: moments of cut cells, to degree CELL_DEGREE=4
#   make section     examples/section: section properties of profiles
#   make glyphs      examples/glyphs, which needs FreeType
#   make render      examples/render, which needs FreeType and libpng; make sheet, make plots:
#                    its contact sheet, and the plots of the filters in examples/filters
#   make playground  build/playground/index.html: a page to draw regions on (clang, lld, wasi-libc)
#   make pictures    all pictures of the documentation, from the programs that measure and draw
#   make filters     the library and render with filters of yours: FILTER='my.filter other.filter'
#   make install     gen, header, libraries, pkg-config and CMake package: DESTDIR= PREFIX=
#                    make uninstall removes them again
#   make generated   emit generated/ anew make layers      no object refers upwards in the pipeline
#   make accept      accept new golden outputs             make clean
#   make deps-playground test-playground  what the page needs, and its tests in Chromium
#   make test-cross  the same bits on other machines       make accept-hashes  accept new bits
#   make test-vendor all ways into the builds of others: C libraries, systems, CMake, Meson, wasm,
#                    packages (make deps-vendor)
# Variables: CC CFLAGS LDFLAGS B (build directory) SAN=1
# (address and undefined-behaviour sanitizers)

CC     ?= cc
CFLAGS ?= -O2
B      ?= build
REQUEST := --max-degree 8
STRICT := -Wall -Wextra -Wpedantic -Wconversion -Wshadow
ifdef SAN
SANITIZE := -fsanitize=address,undefined -fno-sanitize-recover=all
endif
COMPILE = $(CC) $(STRICT) -ffp-contract=off $(SANITIZE) $(CFLAGS)

# In the order of the pipeline: nothing calls a file that stands later.
GEN     := util rational polynomial expression analysis filter spec green dag fuse evaluate \
           constants bound moments compensated curves logarithm distance conic cells window \
           deposit scheme schedule proof residue modular pieces kernel emit emit_edge emit_simd \
           emit_ring emit_deposit emit_environment emit_list emit_header bundle deliver main
RUNTIME := $(addprefix runtime/,edgewise_runtime.h edgewise_precision.h edgewise_dispatch.c \
             edgewise_sides_template.h edgewise_columns_template.h edgewise_columns.c \
             edgewise_rings_template.h edgewise_edges_template.h edgewise_windows_template.h \
             edgewise_path_template.h edgewise_closure_template.h edgewise_trust_template.h \
             edgewise_batches_template.h edgewise_rings.c edgewise_raster_lanes.h \
             edgewise_raster_sweep_template.h edgewise_raster_targets.h edgewise_raster_template.h \
             edgewise_raster_path_template.h edgewise_raster.c edgewise_raster_general.c)
FILTERS := $(addprefix gen/filters/,box.filter tent.filter bspline2.filter bspline3.filter \
             catmull_rom.filter mitchell.filter)
GEN_OBJ := $(GEN:%=$(B)/obj/%.o)
LIB     := $(B)/libedgewise.a
SOURCES  = $(sort $(wildcard $(B)/emitted/*.c))
MATH    := -lmpfr -lgmp -lm

# All cores, unless -j says how many; goals one after the other, as they are named.
ifeq ($(MAKELEVEL)$(filter -j%,$(MAKEFLAGS)),0)
MAKEFLAGS += -j$(shell nproc 2>/dev/null || echo 1)
endif
ifneq ($(word 2,$(MAKECMDGOALS)),)
.NOTPARALLEL:
endif

.PHONY: all library archive generated cutcell section glyphs glyphs-if-freetype render \
        render-if-libraries sheet plots pictures libraries-of-pictures filters FORCE shared \
        shared-library install uninstall test test-cross test-vendor deps deps-vendor bench \
        bench-fonttools deps-bench layers accept accept-hashes clean
.DELETE_ON_ERROR:

all: library $(B)/shapes render-if-libraries
	@$(B)/shapes examples/data/countries.txt

# ---- gen ----

$(B)/obj $(B)/lib $(B)/tests:
	@mkdir -p $@

$(B)/embed: gen/embed.c | $(B)/obj
	$(COMPILE) -o $@ $< $(LDFLAGS)

$(B)/obj/embedded_runtime.c: $(B)/embed $(RUNTIME) Makefile
	$(B)/embed embedded_runtime $(RUNTIME) >$@

$(B)/obj/embedded_filters.c: $(B)/embed $(FILTERS) Makefile
	$(B)/embed embedded_filters $(FILTERS) >$@

$(B)/obj/embedded_%.o: $(B)/obj/embedded_%.c gen/gen.h
	$(CC) $(CFLAGS) $(SANITIZE) -Wno-overlength-strings -std=c11 -Igen -c -o $@ $<

$(B)/obj/%.o: gen/%.c gen/gen.h gen/ops.def | $(B)/obj
	$(COMPILE) -std=c11 -D_POSIX_C_SOURCE=200809L -c -o $@ $<

$(B)/gen: $(GEN_OBJ) $(B)/obj/embedded_runtime.o $(B)/obj/embedded_filters.o
	$(COMPILE) -o $@ $^ $(LDFLAGS)

# ---- emit, and build the library from what was emitted ----

$(B)/emitted.stamp: $(B)/gen
	$(B)/gen $(REQUEST) --out $(B)/emitted
	@touch $@

library: $(LIB)

$(LIB): $(B)/emitted.stamp
	@$(MAKE) --no-print-directory archive

# Which files there are is known once they are emitted.
archive: $(SOURCES:$(B)/emitted/%.c=$(B)/lib/%.o)
	@rm -f $(LIB)
	ar rcs $(LIB) $^

$(B)/lib/%.o: $(B)/emitted/%.c $(wildcard $(B)/emitted/*.h) | $(B)/lib
	$(COMPILE) -std=c99 -c -o $@ $<

generated: $(B)/gen
	$(B)/gen $(REQUEST) --no-runtime --out generated

# ---- install ----

PREFIX     ?= /usr/local
BINDIR     ?= $(PREFIX)/bin
INCLUDEDIR ?= $(PREFIX)/include
LIBDIR     ?= $(PREFIX)/lib
MANDIR     ?= $(PREFIX)/share/man
COMPLETIONDIR ?= $(PREFIX)/share/bash-completion/completions
PKGCONFIGDIR  ?= $(LIBDIR)/pkgconfig
CMAKEDIR   ?= $(LIBDIR)/cmake/edgewise
INSTALL    ?= install

# Before 1.0 another minor version may have another interface, and so another soname.
VERSION := $(shell sed -n 's/^.define GEN_VERSION "\(.*\)"/\1/p' gen/gen.h)
NUMBERS := $(subst ., ,$(VERSION))
ABI     := $(if $(filter 0,$(firstword $(NUMBERS))),0.$(word 2,$(NUMBERS)),$(firstword $(NUMBERS)))
SHARED  := $(B)/libedgewise.so.$(VERSION)
PACKAGE := $(addprefix $(B)/package/,edgewise.pc edgewise-config.cmake \
             edgewise-config-version.cmake)

$(B)/pic $(B)/package:
	@mkdir -p $@

$(B)/pic/%.o: $(B)/emitted/%.c $(wildcard $(B)/emitted/*.h) | $(B)/pic
	$(COMPILE) -std=c99 -fPIC -c -o $@ $<

# What the header declares, and nothing else, is exported.
$(B)/package/edgewise.map: $(B)/emitted.stamp | $(B)/package
	@{ echo 'EDGEWISE_$(ABI) {'; echo 'global:'; $(CC) -E -P $(B)/emitted/edgewise.h | \
		grep -oE '\<ew_([a-z0-9_]+\(|filter_[a-z0-9_]+;)' | tr -d '(;' | sort | \
		sed 's/.*/\t&;/'; echo 'local:'; printf '\t*;\n};\n'; } >$@

$(SHARED): $(SOURCES:$(B)/emitted/%.c=$(B)/pic/%.o) $(B)/package/edgewise.map
	$(COMPILE) -shared -Wl,-soname,libedgewise.so.$(ABI) -Wl,-z,defs \
		-Wl,--version-script,$(B)/package/edgewise.map -o $@ $(filter %.o,$^) $(LDFLAGS) -lm

shared-library: $(SHARED)

shared: $(B)/emitted.stamp
	@$(MAKE) --no-print-directory shared-library

# The folders are those of this run, so these files are written each time.
.PHONY: $(PACKAGE)
$(PACKAGE): $(B)/package/%: runtime/package/%.in | $(B)/package
	@sed -e 's|@VERSION@|$(VERSION)|' -e 's|@ABI@|$(ABI)|' -e 's|@PREFIX@|$(PREFIX)|' \
		-e 's|@BINDIR@|$(BINDIR)|' -e 's|@CMAKEDIR@|$(CMAKEDIR)|' \
		-e 's|@INCLUDEDIR@|$(call OF_PACKAGE,$@,$(INCLUDEDIR))|' \
		-e 's|@LIBDIR@|$(call OF_PACKAGE,$@,$(LIBDIR))|' $< >$@

# FILE FOLDER: pkg-config has a variable for the prefix.
OF_PACKAGE = $(if $(filter %.pc,$1),$(2:$(PREFIX)/%=$${prefix}/%),$2)

# mode:file:place
INSTALLED := 755:$(B)/gen:$(BINDIR)/edgewise-gen \
             644:$(B)/emitted/edgewise.h:$(INCLUDEDIR)/edgewise.h \
             644:$(LIB):$(LIBDIR)/libedgewise.a \
             755:$(SHARED):$(LIBDIR)/libedgewise.so.$(VERSION) \
             644:$(B)/package/edgewise.pc:$(PKGCONFIGDIR)/edgewise.pc \
             $(foreach f,config config-version, \
             644:$(B)/package/edgewise-$f.cmake:$(CMAKEDIR)/edgewise-$f.cmake) \
             644:gen/edgewise-gen.1:$(MANDIR)/man1/edgewise-gen.1 \
             644:runtime/edgewise.3:$(MANDIR)/man3/edgewise.3 \
             644:gen/edgewise-gen.bash:$(COMPLETIONDIR)/edgewise-gen
LINKS     := $(LIBDIR)/libedgewise.so.$(ABI) $(LIBDIR)/libedgewise.so

install: library shared $(PACKAGE)
	@for file in $(INSTALLED); do \
		place=$(DESTDIR)$${file##*:}; from=$${file#*:}; \
		mkdir -p "$${place%/*}" && \
		$(INSTALL) -m $${file%%:*} "$${from%:*}" "$$place" || exit 1; \
	done
	@for link in $(LINKS); do ln -sf $(notdir $(SHARED)) "$(DESTDIR)$$link" || exit 1; done

uninstall:
	@for file in $(INSTALLED) $(LINKS); do rm -f "$(DESTDIR)$${file##*:}"; done
	@rmdir "$(DESTDIR)$(CMAKEDIR)" 2>/dev/null || :

# ---- examples and bench ----

$(B)/shapes: examples/shapes.c examples/outline.h $(LIB)
	$(COMPILE) -std=c11 -I$(B)/emitted -o $@ $< $(LIB) $(LDFLAGS) -lm

# Cut cells: the filters x^m y^n on a cell, for all m + n <= CELL_DEGREE, as files, and a library of
# them, which tells the program what it has.
CELL_DEGREE := 4
CELL        := $(B)/cells
CELL_KNOWN   = $$(sed -n 's/^extern .* ew_filter_cell_x\(.*\)y\(.*\);/X(\1, \2)/p' \
               $(CELL)/emitted/edgewise.h | tr '\n' ' ')
CELL_BUILD   = -std=c11 "-DCELL_MOMENTS(X)=$(CELL_KNOWN)" -I$(CELL)/emitted

$(B)/cells.degree: FORCE
	@echo $(CELL_DEGREE) | cmp -s - $@ || echo $(CELL_DEGREE) >$@

$(CELL)/emitted.stamp: $(B)/gen $(B)/cells.degree
	@rm -rf $(CELL)
	@mkdir -p $(CELL)
	@m=0; while [ $$m -le $(CELL_DEGREE) ]; do \
		n=0; while [ $$((m + n)) -le $(CELL_DEGREE) ]; do \
			printf 'filter cell_x%dy%d\nbivariate\npiece -1/2 1/2 -1/2 1/2 : x^%d*y^%d\n' \
				$$m $$n $$m $$n >$(CELL)/x$${m}y$$n.filter; n=$$((n + 1)); \
		done; m=$$((m + 1)); \
	done
	$(B)/gen --max-degree $(CELL_DEGREE) --families moments --precision double \
		--targets portable,fma --quiet \
		$$(printf -- '--filter %s ' $(CELL)/*.filter) --out $(CELL)/emitted
	@touch $@

$(CELL)/cells.a: $(CELL)/emitted.stamp
	@cd $(CELL)/emitted && for f in *.c; do \
		$(COMPILE) -std=c99 -c -o "$${f%.c}.o" "$$f" || exit 1; done && ar rcs ../cells.a *.o

$(B)/cutcell: examples/cutcell.c examples/outline.h $(CELL)/cells.a
	$(COMPILE) $(CELL_BUILD) -o $@ $< $(CELL)/cells.a $(LDFLAGS) -lm

cutcell: $(B)/cutcell

$(B)/section: examples/section.c examples/outline.h $(LIB)
	$(COMPILE) -std=c11 -I$(B)/emitted -o $@ $< $(LIB) $(LDFLAGS) -lm

section: $(B)/section

# Where pkg-config does not know FreeType, it may still stand in its usual place.
FREETYPE = $(or $(shell pkg-config --cflags --libs freetype2 2>/dev/null), \
           -I/usr/include/freetype2 -lfreetype)

$(B)/glyphs: examples/glyphs.c examples/face.h examples/utf8.h $(LIB)
	$(COMPILE) -std=c11 -I$(B)/emitted -o $@ $< $(LIB) $(LDFLAGS) $(FREETYPE) -lm

glyphs: $(B)/glyphs

glyphs-if-freetype: $(LIB)
	@if echo '#include <ft2build.h>' | $(CC) -x c -fsyntax-only $(FREETYPE) - 2>/dev/null; then \
		$(MAKE) --no-print-directory glyphs; \
	else \
		rm -f $(B)/glyphs; \
	fi

PNG = $(or $(shell pkg-config --cflags --libs libpng 2>/dev/null),-lpng)
RENDER := $(addprefix examples/render/,main.c drawing.c font.c svg.c countries.c picture.c png.c \
            sheet.c)
# render knows the filters that the header in this folder declares.
KNOWN_FILTERS = $$(sed -n 's/^extern const ew_filter ew_filter_\(.*\);/X(\1)/p' \
                $1/edgewise.h | tr '\n' ' ')
RENDER_BUILD = $(COMPILE) -std=c11 "-DRENDER_FILTERS(X)=$(call KNOWN_FILTERS,$1)" -I$1 -o $@ \
               $(RENDER) $2 $(LDFLAGS) $(FREETYPE) $(PNG) -lm

$(B)/render: $(RENDER) examples/render/render.h examples/face.h examples/utf8.h $(LIB)
	$(call RENDER_BUILD,$(B)/emitted,$(LIB))

render: $(B)/render

sheet: $(B)/render
	$(B)/render sheet examples/render/sheet.png

HAS_RENDER_LIBRARIES = \
	printf '\#include <ft2build.h>\n\#include <stdio.h>\n\#include <png.h>\n' | \
	$(CC) -x c -fsyntax-only $(FREETYPE) $(PNG) - 2>/dev/null

render-if-libraries: $(LIB)
	@if $(HAS_RENDER_LIBRARIES); then \
		$(MAKE) --no-print-directory render; \
	else \
		rm -f $(B)/render $(B)/filters/render; \
	fi

# The library with filters of the user's besides its own, in $(B)/filters, and render with it.
FILTER   ?= $(sort $(wildcard examples/filters/*.filter))
FILTERED  = $(sort $(wildcard $(B)/filters/emitted/*.c))

$(B)/filters $(B)/filters/lib:
	@mkdir -p $@

filters: $(B)/gen | $(B)/filters
	$(B)/gen --families filters $(FILTER:%=--filter %) \
		--out $(B)/filters/emitted
	@$(MAKE) --no-print-directory $(B)/filters/render

$(B)/filters/lib/%.o: $(B)/filters/emitted/%.c $(wildcard $(B)/filters/emitted/*.h) \
		| $(B)/filters/lib
	$(COMPILE) -std=c99 -c -o $@ $<

$(B)/filters/libedgewise.a: $(FILTERED:$(B)/filters/emitted/%.c=$(B)/filters/lib/%.o)
	@rm -f $@
	ar rcs $@ $^

$(B)/filters/render: $(RENDER) examples/render/render.h examples/face.h examples/utf8.h \
		$(B)/filters/libedgewise.a
	$(call RENDER_BUILD,$(B)/filters/emitted,$(B)/filters/libedgewise.a)

# plot reads filters as gen does. Beside each of ours stands one that is built in.
PLOTS := bspline5:bspline3 quintic:mitchell disc:bspline3

$(B)/plot: examples/filters/plot.c bench/svg.c bench/svg.h \
		$(filter-out %/main.o %/deliver.o %/bundle.o,$(GEN_OBJ)) $(B)/obj/embedded_filters.o
	$(COMPILE) -std=c11 -D_POSIX_C_SOURCE=200809L -Igen -Ibench -o $@ $(filter-out %.h,$^) \
		$(LDFLAGS) -lm

plots: $(B)/plot
	for pair in $(PLOTS); do \
		name=examples/filters/$${pair%:*}; \
		$(B)/plot $$name.filter $${pair#*:} $$name.svg || exit 1; \
	done

# ---- the playground: a page in one file, with the kernels as WebAssembly in it ----

.PHONY: playground playground-if-tools test-playground deps-playground

PLAYGROUND := $(addprefix examples/playground/,pack.sh index.html style.css library.js shape.js \
              text.js figure.js terms.js region.js pictures.js below.js main.js)

# What the page calls by itself, besides playground.c.
PLAYGROUND_CALLS := below line_coverage line_area quad_area conic_area cubic_area

$(B)/playground:
	@mkdir -p $@

$(B)/playground/emitted.stamp: $(B)/gen | $(B)/playground
	$(B)/gen --max-degree 2 --families moments,curves,distance,coverage --filter box \
		--filter tent --filter mitchell --precision double --targets wasm128 --quiet \
		--out $(B)/playground/emitted
	@touch $@

$(B)/playground/edgewise.wasm: examples/playground/playground.c $(B)/playground/emitted.stamp
	clang --target=wasm32-wasi -msimd128 -std=c11 $(STRICT) -ffp-contract=off -Oz \
		-fvisibility=hidden -ffunction-sections -fdata-sections -I$(B)/playground/emitted \
		-nostartfiles -Wl,--no-entry,--gc-sections,--strip-all,--export-dynamic \
		$(PLAYGROUND_CALLS:%=-Wl,--export=ew_%) \
		-o $@ $< $(B)/playground/emitted/*.c -lm

$(B)/playground/index.html: $(B)/playground/edgewise.wasm $(PLAYGROUND)
	sh examples/playground/pack.sh $< >$@

playground: $(B)/playground/index.html

$(B)/tests/playground: tests/playground.c $(LIB) | $(B)/tests
	$(COMPILE) -std=c11 -I$(B)/emitted -o $@ $< $(LIB) $(LDFLAGS) -lm

playground-if-tools:
	@if echo '#include <math.h>' | clang --target=wasm32-wasi -x c -fsyntax-only - 2>/dev/null && \
		command -v wasm-ld >/dev/null; then \
		$(MAKE) --no-print-directory playground; \
	else \
		rm -f $(B)/playground/index.html; \
	fi

test-playground: $(B)/tests/playground playground-if-tools
	@sh tests/run.sh $(B)/tests/logs 'playground: sh tests/playground.sh $(B)'

# The browser is Debian's; what steers it is one package of npm, for this folder only.
PLAYWRIGHT := playwright-core@1.56.1

deps-playground:
	@$(MAKE) --no-print-directory deps PACKAGES='clang lld wasi-libc libclang-rt-14-dev-wasm32 \
		chromium $(shell command -v node >/dev/null || echo nodejs) \
		$(shell command -v npm >/dev/null || echo npm)'
	@mkdir -p $(B)/playground
	@cd $(B)/playground && PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD=1 npm install --silent --no-audit \
		--no-fund --prefix . $(PLAYWRIGHT)

# ---- bench: make bench BENCH='--quick --json FILE'; peers are optional (make deps-bench) ----

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

# ---- tests ----

GEN_TESTS   := units constants filter_files
RING_TESTS  := rings lanes central ring_contract long_rings kernels batches bounded compensated \
               distance closure
CURVE_TESTS := curves conics paths
WINDOW_TESTS := windows window_rings filters
RASTER_TESTS := raster raster_bits raster_fuzz raster_contract raster_paths raster_memory
CUSTOM_TESTS := filters raster_custom raster_memory
PROGRAMS    := $(addprefix $(B)/tests/,$(GEN_TESTS) lines polynomials monomials shapes glyphs cutcell \
               section \
               $(RING_TESTS) $(CURVE_TESTS) $(WINDOW_TESTS) $(RASTER_TESTS)) \
               $(CUSTOM_TESTS:%=$(B)/tests/custom/%)
TEST_BUILD  = $(CC) -std=gnu11 -Wall -Wextra -ffp-contract=off $(SANITIZE) $(CFLAGS) -Itests

# Expressions of the table in tests/polynomials.c.
$(B)/polynomials.stamp: $(B)/gen
	$(B)/gen --max-degree 1 --families moments --polynomial 'soft=(1-x)*(1-y)' \
		--polynomial 'saddle=x^2-y^2' \
		--polynomial 'deep=x^5*y^3/7 - 2.5*x^2*y^4 - 2*x + 1/3' --out $(B)/polynomials
	@touch $@

# Monomials of the table in tests/monomials.c.
$(B)/monomials.stamp: $(B)/gen
	$(B)/gen --monomial x4y2 --monomial x0y3 --monomial x5y1 --edges line,quad,cubic \
		--targets portable --no-runtime --out $(B)/monomials
	@touch $@

# Filters of the tables in tests/filter_list.h, by the same sources as the built-in ones.
FILTER_FILES := $(wildcard tests/filters/*.filter)

$(B)/custom.stamp: $(B)/gen $(FILTER_FILES)
	$(B)/gen --max-degree 1 --families moments,coverage $(FILTER_FILES:%=--filter %) \
		--quiet --out $(B)/custom
	@touch $@

$(B)/custom/custom.a: $(B)/custom.stamp
	@cd $(@D) && rm -f $(@F) *.o && for f in *.c; do \
		$(COMPILE) -std=c99 -c -o "$${f%.c}.o" "$$f" || exit 1; done && ar rcs $(@F) *.o

# What tests share, compiled once.
REFERENCE = $(B)/tests/reference.o

$(B)/tests/%.o: tests/%.c $(wildcard tests/*.h) | $(B)/tests
	$(TEST_BUILD) -c -o $@ $<

$(CUSTOM_TESTS:%=$(B)/tests/custom/%): $(B)/tests/custom/%: tests/%.c $(REFERENCE) \
		$(B)/tests/window_reference.o $(B)/tests/raster_reference.o $(wildcard tests/*.h) \
		$(B)/custom/custom.a
	@mkdir -p $(@D)
	$(TEST_BUILD) -DCUSTOM_FILTERS -I$(B)/custom -o $@ $(filter %.c %.o %.a,$^) $(LDFLAGS) \
		$(MATH)

$(GEN_TESTS:%=$(B)/tests/%): $(B)/tests/%: tests/%.c tests/check.h \
		$(filter-out %/main.o %/deliver.o %/bundle.o,$(GEN_OBJ)) \
		$(B)/obj/embedded_filters.o | $(B)/tests
	$(TEST_BUILD) -o $@ $(filter %.c %.o,$^) $(LDFLAGS) $(MATH)

$(B)/tests/polynomials: tests/polynomials.c $(REFERENCE) $(B)/polynomials.stamp
	$(TEST_BUILD) -I$(B)/polynomials -o $@ $(filter %.c %.o,$^) $(B)/polynomials/*.c \
		$(LDFLAGS) $(MATH)

$(B)/tests/cutcell: tests/cutcell.c $(REFERENCE) $(B)/tests/window_reference.o \
		$(wildcard tests/*.h) $(CELL)/emitted.stamp
	$(TEST_BUILD) $(CELL_BUILD) -o $@ $(filter %.c %.o,$^) $(LDFLAGS) $(MATH)

$(B)/tests/monomials: tests/monomials.c $(REFERENCE) $(B)/monomials.stamp
	$(TEST_BUILD) -I$(B)/monomials -DMANIFEST='"$(B)/monomials/edgewise_manifest.json"' -o $@ \
		$(filter %.c %.o,$^) $(B)/monomials/edgewise_line*.c $(LDFLAGS) $(MATH)

$(B)/tests/distance: $(B)/tests/distance_reference.o

$(CURVE_TESTS:%=$(B)/tests/%) $(B)/tests/section: $(B)/tests/curve_reference.o

$(WINDOW_TESTS:%=$(B)/tests/%): $(B)/tests/window_reference.o $(B)/tests/window_area.o

$(RASTER_TESTS:%=$(B)/tests/%): $(B)/tests/window_reference.o $(B)/tests/raster_reference.o

$(B)/tests/%: tests/%.c $(REFERENCE) $(wildcard tests/*.h) $(LIB)
	$(TEST_BUILD) -I$(B)/emitted -o $@ $(filter %.c %.o,$^) $(LIB) $(LDFLAGS) $(MATH)

test: $(PROGRAMS) $(B)/shapes $(B)/cutcell $(B)/section $(B)/plot $(B)/origin \
		glyphs-if-freetype render-if-libraries
	@if [ -x $(B)/render ]; then $(MAKE) --no-print-directory filters; fi
	@sh tests/run.sh $(B)/tests/logs \
		'matrix: sh tests/matrix.sh $(B)' \
		'command-line: sh tests/cli.sh $(B)/gen' \
		$(foreach t,msvc same_output mutation,'$(t): sh tests/$(t).sh $(B)') \
		'vendor: sh tests/vendor.sh $(B) area/cc header/c99 header/c++17 two/cc' \
		$(foreach t,fuzz filter_fuzz render,'$(t): sh tests/$(t).sh $(B)') \
		$(foreach t,$(RASTER_TESTS) $(RING_TESTS) $(CURVE_TESTS) $(WINDOW_TESTS), \
			'$(t): $(B)/tests/$(t)') \
		$(foreach t,$(CUSTOM_TESTS),'custom-$(t): $(B)/tests/custom/$(t)') \
		$(foreach t,$(GEN_TESTS) lines polynomials monomials,'$(t): $(B)/tests/$(t)') \
		$(foreach t,glyphs cutcell section pictures docs counts golden readme house, \
			'$(t): sh tests/$(t).sh $(B)') \
		'shapes: $(B)/shapes --exact examples/data/countries.txt | $(B)/tests/shapes' \
		'layers: sh tests/layers.sh $(B) "$(GEN)"'

# All ways from an empty folder to a program, other C libraries and systems, build systems, and
# what is installed; then what all that brings into a program.
test-vendor: library
	@sh tests/run.sh $(B)/tests/logs 'ways: sh tests/vendor.sh $(B)' \
		'symbols: sh tests/symbols.sh $(B)'

VENDOR_PACKAGES := gcc g++ clang tcc make binutils libc6-dev musl-tools gcc-i686-linux-gnu \
                   libc6-dev-i386-cross qemu-user gcc-mingw-w64-x86-64 wine wine64 lld wasi-libc \
                   libclang-rt-14-dev-wasm32 nodejs pkg-config cmake ninja-build meson
deps-vendor:
	@$(MAKE) --no-print-directory deps PACKAGES='$(VENDOR_PACKAGES)'

# The emitted library on other machines, by cross compilers and qemu, against tests/hashes.txt.
test-cross: library
	@CC='$(CC)' sh tests/run.sh $(B)/tests/logs 'cross: sh tests/cross.sh $(B)'

# After a change of the definition only: it says that different bits are right from now on.
accept-hashes: library
	@CC='$(CC)' sh tests/cross.sh $(B) accept

layers: $(B)/gen
	@sh tests/layers.sh $(B) "$(GEN)"

accept: $(B)/gen
	@sh tests/golden.sh $(B) accept

# gmp and mpfr for the reference; the other compilers only widen the compile matrix; the cross
# compilers and qemu are for test-cross. (gcc-multilib would remove the cross compilers.) FreeType,
# fonts and fontTools are for examples/glyphs, libpng is for examples/render; with munkres fontTools
# does without SciPy. mandoc and bash are for tests/docs.sh. ctags tells how long functions are.
PACKAGES := gcc g++ clang libclang-rt-14-dev tcc make binutils libc6-dev libgmp-dev libmpfr-dev \
            gcc-aarch64-linux-gnu libc6-dev-arm64-cross gcc-i686-linux-gnu \
            libc6-dev-i386-cross gcc-s390x-linux-gnu libc6-dev-s390x-cross qemu-user \
            lld wasi-libc libclang-rt-14-dev-wasm32 nodejs \
            libfreetype-dev libpng-dev pkg-config fonts-dejavu-core fonts-gfs-didot \
            python3-fonttools python3-munkres mandoc bash universal-ctags
deps:
	@if command -v apt-get >/dev/null; then \
		run=; [ "$$(id -u)" = 0 ] || run=sudo; \
		$$run apt-get update -qq && \
		DEBIAN_FRONTEND=noninteractive $$run apt-get install -y -qq \
			--no-install-recommends $(PACKAGES) >/dev/null; \
	else \
		echo "make deps knows Debian's package names only;" \
			"install the equivalents of: $(PACKAGES)"; exit 1; \
	fi

clean:
	rm -rf $(B)
