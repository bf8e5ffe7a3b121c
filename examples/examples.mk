# examples.mk - the programs in this folder.

.PHONY: cutcell section glyphs glyphs-if-freetype render render-if-libraries sheet plots filters

$(B)/shapes: examples/shapes.c examples/command_line.h examples/outline.h $(LIB)
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

$(B)/cutcell: examples/cutcell.c examples/command_line.h examples/outline.h $(CELL)/cells.a
	$(COMPILE) $(CELL_BUILD) -o $@ $< $(CELL)/cells.a $(LDFLAGS) -lm

cutcell: $(B)/cutcell

$(B)/section: examples/section.c examples/command_line.h examples/outline.h $(LIB)
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
