# tests.mk - programs of tests, and the suites in which they run.

.PHONY: test test-vendor deps-vendor test-cross accept-hashes

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
