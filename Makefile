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
             edgewise_batches_template.h edgewise_rings.c edgewise_raster_edge.h \
             edgewise_raster_lanes.h edgewise_raster_sweep_template.h edgewise_raster_targets.h \
             edgewise_raster_template.h edgewise_raster_path_template.h edgewise_raster.c \
             edgewise_raster_general.c)
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

.PHONY: all library archive generated layers accept deps clean FORCE
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

# ---- the other rooms ----

include runtime/package/install.mk examples/examples.mk examples/playground/playground.mk \
        bench/bench.mk tests/tests.mk

# ---- what looks after the house ----

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
