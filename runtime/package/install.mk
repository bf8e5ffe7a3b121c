# install.mk - make install, make uninstall, and the shared library that they need.

.PHONY: shared shared-library install uninstall

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
