# Edgewise. Targets:
#   make             build gen, emit, build build/libedgewise.a, run examples/shapes on real data
#   make deps        install what the tests need (Debian: apt-get)
#   make test        all tests            make bench       operation counts and ns per edge
#   make generated   emit generated/ anew make layers      no object refers upwards in the pipeline
#   make accept      accept new golden outputs             make clean
# Variables: CC CFLAGS LDFLAGS B (build directory) SAN=1 (address and undefined-behaviour sanitizers)

CC     ?= cc
CFLAGS ?= -O2 -g
B      ?= build
DEGREE := 8
STRICT := -Wall -Wextra -Wpedantic -Wconversion -Wshadow
ifdef SAN
SANITIZE := -fsanitize=address,undefined -fno-sanitize-recover=all
endif
COMPILE = $(CC) $(STRICT) -ffp-contract=off $(SANITIZE) $(CFLAGS)

# In the order of the pipeline: nothing calls a file that stands later.
GEN     := util rational polynomial spec green dag fuse scheme schedule proof kernel \
           emit emit_edge emit_ring emit_list emit_header bundle deliver main
RUNTIME := $(addprefix runtime/,edgewise_runtime.h edgewise_dispatch.c edgewise_rings_template.h edgewise_rings.c)
GEN_OBJ := $(GEN:%=$(B)/obj/%.o)
LIB     := $(B)/libedgewise.a
SOURCES  = $(sort $(wildcard $(B)/emitted/*.c))
MATH    := -lmpfr -lgmp -lm

.PHONY: all library objects generated test deps bench layers accept clean
.DELETE_ON_ERROR:

all: library $(B)/shapes
	@$(B)/shapes examples/data/countries.txt

# ---- gen ----

$(B)/obj $(B)/lib $(B)/tests:
	@mkdir -p $@

$(B)/embed: gen/embed.c | $(B)/obj
	$(COMPILE) -o $@ $< $(LDFLAGS)

$(B)/obj/embedded.c: $(B)/embed $(RUNTIME)
	$(B)/embed $(RUNTIME) >$@

$(B)/obj/embedded.o: $(B)/obj/embedded.c gen/gen.h
	$(CC) $(CFLAGS) $(SANITIZE) -Wno-overlength-strings -std=c11 -Igen -c -o $@ $<

$(B)/obj/%.o: gen/%.c gen/gen.h gen/ops.def | $(B)/obj
	$(COMPILE) -std=c11 -D_POSIX_C_SOURCE=200809L -c -o $@ $<

$(B)/gen: $(GEN_OBJ) $(B)/obj/embedded.o
	$(COMPILE) -o $@ $^ $(LDFLAGS)

# ---- emit, and build the library from what was emitted ----

$(B)/emitted.stamp: $(B)/gen
	$(B)/gen --max-degree $(DEGREE) --out $(B)/emitted
	@touch $@

library: $(B)/emitted.stamp
	@$(MAKE) --no-print-directory objects

objects: $(LIB)

$(LIB): $(SOURCES:$(B)/emitted/%.c=$(B)/lib/%.o)
	@rm -f $@
	ar rcs $@ $^

$(B)/lib/%.o: $(B)/emitted/%.c $(B)/emitted/edgewise.h $(B)/emitted/edgewise_kernels.h | $(B)/lib
	$(COMPILE) -std=c99 -c -o $@ $<

generated: $(B)/gen
	$(B)/gen --max-degree $(DEGREE) --no-runtime --out generated

# ---- examples, tests, bench ----

$(B)/shapes: examples/shapes.c library
	$(COMPILE) -std=c11 -I$(B)/emitted -o $@ $< $(LIB) $(LDFLAGS) -lm

clean:
	rm -rf $(B)
