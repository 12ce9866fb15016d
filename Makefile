# What takes more than building and testing. The rest: dune build, dune test.
.PHONY: site nightly tlc crosscheck refinement mutate mutate-code coverage proofs

# The documentation as a site, searchable, its links checked: _build/site/html.
site:
	@scripts/site

# All that is too slow for every change, a line each; ONLY="mutate peers" picks. scripts/nightly tells more.
nightly:
	@scripts/nightly $(ONLY)

# The proofs of proofs/, checked by Coq: docs/proofs.md.
proofs:
	@scripts/proofs

# TLC, where `dolphin tla --run` finds it.
tlc:
	@scripts/tlc

# TLC and the explorer on all examples and on random programs; docs/crosscheck.md.
crosscheck: tlc
	dune build bin/dolphin.exe test/crosscheck/crosscheck.exe
	_build/default/test/crosscheck/crosscheck.exe all

# That programs refine spec/Abstract.tla, by TLC: examples, small programs and PROGRAMS random ones of each kind.
refinement: tlc
	dune build test/crosscheck/crosscheck.exe
	_build/default/test/crosscheck/crosscheck.exe refinement

# Specifications that are wrong in one place, each of which the comparison must notice.
mutate: tlc
	dune build test/crosscheck/crosscheck.exe
	_build/default/test/crosscheck/crosscheck.exe mutate

# Mistakes in lib/: COUNT of them (40) at places drawn by SEED, below FOLDERS="lib/time lib/runtime" or anywhere; then
# those made by hand, each of which a test must notice. AT=FILE:LINE makes every mistake of that line instead, MISTAKES=
# "words of their names or files" some of those made by hand. COPY=FOLDER keeps what is built. See CONTRIBUTING.md.
mutate-code:
	dune build test/mutants/mutants.exe
ifdef AT
	_build/default/test/mutants/mutants.exe at $(AT)
else ifdef MISTAKES
	_build/default/test/mutants/mutants.exe by-hand $(MISTAKES)
else
	_build/default/test/mutants/mutants.exe drawn
	_build/default/test/mutants/mutants.exe by-hand
endif

# That the examples use every rule of the specification, by TLC's own -coverage.
coverage: tlc
	dune build test/crosscheck/crosscheck.exe
	_build/default/test/crosscheck/crosscheck.exe coverage
