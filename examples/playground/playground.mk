# playground.mk - a page in one file, with the kernels as WebAssembly in it.

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
