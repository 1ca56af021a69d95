# CubicCraft. The two commands to begin with: make render, make test.

# The first that runs and is of the version: a name on PATH may be a shim without a Python behind it.
find_python = $(shell for p in python$(1) python3 $(HOME)/.pyenv/versions/$(1)*/bin/python3; do \
	$$p -c 'import sys; sys.exit(sys.version_info[:2] != tuple(map(int, "$(1)".split("."))))' \
	2>/dev/null && echo $$p && break; done)
# With 3.13, the newest Blender as a module; with 3.11, the newest that there is for it.
PYTHON ?= $(or $(call find_python,3.13),$(PYTHON311))
PYTHON311 ?= $(call find_python,3.11)
VENV := .venv
PY := $(VENV)/bin/python
# To compile what nobody imports takes most of the time.
PIP := -m pip install --quiet --disable-pip-version-check --no-compile
# But tests read what is said beside Taichi, and Python 3.13 warns of a line of it when it is compiled.
compile_taichi = $(1)/bin/python -m compileall -q $(1)/lib/python3*/site-packages/taichi
# Whole files go to as many processes as there are cores, in the order given: the longest are named
# first. Not more than four, as each Blender takes its memory. A process that crashes ends the run: with
# another one in its place, --dist loadfile may wait for ever.
PYTEST := -m pytest -c tests/pytest.ini --rootdir tests -n auto --maxprocesses 4 --dist loadfile --no-loadscope-reorder --max-worker-restart 0 $(THOROUGH)
# A thread each for matrices of NumPy and SciPy: more than there are cores wait for each other at full
# speed. tests/solver/global_step/test_tall_products.py has several; so have windows.
test-solver test-blender test-oldest test-quadrants test-gpu test-wheel: export OPENBLAS_NUM_THREADS ?= 1
ZIP := dist/cubic_craft.zip
BARE := $(VENV)-bare-oldest $(VENV)-bare-newest
SOURCES := __init__.py blender_manifest.toml \
	$(shell find solver cubic_craft_addon operators -name "*.py" -o -name "*.png")

.DEFAULT_GOAL := help
.PHONY: help setup setup-all setup-gui render docs test test-thorough test-solver test-blender test-oldest test-quadrants \
	test-hostile test-reliability test-gpu test-gui test-walk test-package lint typecheck \
	build package upload repository release lock wheel test-wheel bench bench-quick example-pictures films docs-images clean

help: ## Show this list
	@grep -E '^[a-z0-9-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 16

setup: $(VENV)/.done ## Make the virtual environment .venv, with Blender as a Python module

$(VENV)/.done: requirements/*.txt
	@test -n "$(PYTHON)" || { echo "no Python 3.13 or 3.11 found, for which bpy modules are built;" \
		"set it: make PYTHON=path/to/python3.13"; exit 1; }
	$(PYTHON) -m venv --clear $(VENV)
	$(PY) $(PIP) -r requirements/dev.txt -r requirements/lint.txt -r requirements/package.txt \
		-r requirements/blender-newest.txt
	$(call compile_taichi,$(VENV))
	@touch $@

render: setup ## Picture of a mesh beside its cubic versions; MESH=file, ARGS=options
	@mkdir -p build
	$(PY) scripts/headless_render.py $(if $(MESH),"$(MESH)") --cubeness 0.2 0.4 1.0 \
		--output build/render.png $(ARGS)
	@echo "Look at build/render.png"

test: test-solver test-blender ## Tests that need no window; of many equal cases a few

test-thorough: ## All cases of them; an hour
	$(MAKE) test THOROUGH=--thorough

test-solver: setup ## The solver, what decides in Live, packages, and the documentation, without Blender
	$(PY) $(PYTEST) tests/hostile tests/solver tests/live tests/packages tests/docs

# Leaks take minutes to be seen: test-reliability looks for them.
test-blender: setup $(ZIP) ## The built extension, installed in the newest bpy
	CUBIC_CRAFT_ZIP=$(ZIP) $(PY) $(PYTEST) --ignore tests/blender/test_leaks.py \
		tests/art tests/scripts tests/blender

test-hostile: setup $(ZIP) ## Broken meshes, EXAMPLES=50000 of them, others in each run
	CUBIC_CRAFT_EXAMPLES=$(or $(EXAMPLES),50000) $(PY) $(PYTEST) tests/hostile
	CUBIC_CRAFT_EXAMPLES=$(or $(EXAMPLES),50000) CUBIC_CRAFT_ZIP=$(ZIP) \
		$(PY) $(PYTEST) tests/blender/hostile

# What Blender itself does for us: data, modes, undo, interface, importers and exporters. What is
# computed from it, and faults of Python functions, are the same in both; of each test, two cases are
# enough to see another Blender. Blender 4.2 crashes now and then in its glTF exporter if a mesh was in
# Edit Mode in a file before, without any extension too (docs/reliability.md): what exports has
# processes of its own.
test-oldest: $(VENV)-oldest/.done $(ZIP) ## What depends on the versions of Blender and Python, in the oldest that we support
	CUBIC_CRAFT_ZIP=$(ZIP) $(VENV)-oldest/bin/python $(PYTEST) --few 2 --ignore tests/blender/hostile \
		--ignore tests/blender/mesh_bridge/test_bridge_faults.py \
		$(patsubst %,--ignore-glob "*/test_%.py",assembly cages docs_examples edited examples faults \
		flatten_facets flatten_ngons floor form_from_selection form_settings handle_own_pose handle_reach \
		handles keyed_settings leaks live_crisp live_inputs live_poses live_transforms \
		orientation other_blenders posed_anew refusals regions rigged_limbs scenes \
		symmetry up_to_date) \
		--ignore tests/blender/send tests/blender \
		$(patsubst %,tests/scripts/test_headless_%.py,bake picture round_trip seen)
	CUBIC_CRAFT_ZIP=$(ZIP) $(VENV)-oldest/bin/python $(PYTEST) --few 2 tests/blender/send
	$(VENV)-oldest/bin/python $(PYTEST) --few 1 -m "not thorough" -k "not [numpy" tests/solver/backends

$(VENV)-oldest/.done: requirements/*.txt
	@test -n "$(PYTHON311)" || { echo "no Python 3.11 found; set it: make PYTHON311=path"; exit 1; }
	$(PYTHON311) -m venv --clear $(VENV)-oldest
	$(VENV)-oldest/bin/python $(PIP) -r requirements/dev.txt -r requirements/blender-oldest.txt
	@touch $@

WITH_KERNELS := $(addprefix tests/solver/,backends coarse_to_fine test_reference_meshes.py test_stylize.py)

# Taichi runs in all other environments, in windows too. What needs no kernel is the same with both.
test-quadrants: $(VENV)-quadrants/.done ## The solver with Quadrants in place of Taichi
	$(VENV)-quadrants/bin/python $(PYTEST) --few 1 -m "not thorough" -k "not [numpy" $(WITH_KERNELS)

$(VENV)-quadrants/.done: requirements/*.txt
	@test -n "$(PYTHON)" || { echo "no Python 3.13 or 3.11 found; set it: make PYTHON=path"; exit 1; }
	$(PYTHON) -m venv --clear $(VENV)-quadrants
	$(VENV)-quadrants/bin/python $(PIP) -r requirements/dev.txt \
		"$$(sed -n 's/^\(quadrants==[^;]*\);.*/\1/p' requirements/solver.txt)"
	$(VENV)-quadrants/bin/python -m pip uninstall --quiet --yes taichi
	@touch $@

test-reliability: setup $(ZIP) $(VENV)-oldest/.done ## The long runs of docs/reliability.md; hours
	CUBIC_CRAFT_ZIP=$(ZIP) CUBIC_CRAFT_FAULTS=1 CUBIC_CRAFT_ROUNDS=1000 CUBIC_CRAFT_OBJECTS=1000 \
		CUBIC_CRAFT_KILLS=100 CUBIC_CRAFT_OLDER_PYTHON=$(VENV)-oldest/bin/python \
		$(PY) $(PYTEST) --thorough tests/blender/test_faults.py tests/blender/mesh_bridge/test_bridge_faults.py tests/blender/test_leaks.py \
		tests/blender/test_scenes.py tests/blender/environment/test_other_blenders.py \
		tests/scripts/test_headless_interrupted.py

# Of each test one case, as what differs is the device; without comparisons of whole runs that take
# long, and that test_device_arrays.py makes of the device, and without what the host decides.
ON_HOST := acceleration or nothing_crosses or coarse_start or sequence or from_below or symmetry or limbs \
	or links or vertex_order or cancelled or at_a_time or turning or nothing_turns or components
test-gpu: setup $(ZIP) ## What runs on a GPU, on Mesa's on the processor; GPU=own for your own
	GPU="$(GPU)" tests/on_gpu.sh $(GPU_OPTIONS) sh -c '$(PY) $(PYTEST) --few 1 -k "(gpu or device_arrays) and not ($(ON_HOST))" \
		--deselect solver/global_step/test_multigrid.py::test_it_ends_where_the_factorisation_does \
		tests/solver/test_stylize.py tests/solver && \
		CUBIC_CRAFT_ZIP=$(ZIP) $(PY) $(PYTEST) tests/blender/test_gpu.py'

ENVIRONMENTS := $(foreach name,-oldest -docs -wheel -bare-oldest -bare-newest -quadrants,$(VENV)$(name)/.done)

setup-all: $(ZIP) $(ENVIRONMENTS) setup-gui ## All that the tests need, ahead of them; side by side with -j

setup-gui:
	tests/gui/set_up.sh $(GUI_OPTIONS) trixie sid

test-gui: $(ZIP) ## The built extension in real Blender windows; BLENDER=path for your own
	tests/gui/run.sh $(GUI_OPTIONS) $(ZIP)

test-walk: $(ZIP) ## Random walks through real Blender windows; SEEDS="1 2" ACTIONS=500
	for seed in $(or $(SEEDS),1 2 3 4 5); do for suite in $(if $(BLENDER),blender,trixie sid); do \
		TESTS=test_random_walk WALK_SEED=$$seed WALK_ACTIONS=$(or $(ACTIONS),500) \
		tests/gui/run.sh $(ZIP) build/walks/$$seed $$suite || exit 1; done; done

test-package: setup $(BARE:=/.done) $(ZIP) ## The Linux packages, in a bpy that has nothing else
	$(PY) scripts/package build $(ZIP) --platforms linux-x64
	CUBIC_CRAFT_BARE_PYTHONS="$(BARE:=/bin/python)" \
		CUBIC_CRAFT_PACKAGES=dist/packages $(PY) $(PYTEST) tests/packages/test_installed.py

$(VENV)-bare-%/.done: requirements/blender-%.txt
	$(if $(filter oldest,$*),$(PYTHON311),$(PYTHON)) -m venv --clear $(VENV)-bare-$*
	$(VENV)-bare-$*/bin/python $(PIP) -r $<
	@touch $@

lint: setup ## Style and formatting
	$(VENV)/bin/ruff check .
	$(VENV)/bin/ruff format --check .

typecheck: setup ## Types
	$(VENV)/bin/pyright

build: $(ZIP) ## The extension as Blender installs it

$(ZIP): $(VENV)/.done $(SOURCES)
	$(PY) scripts/build_extension.py $@

package: setup $(ZIP) ## One zip for each platform and Python that brings its wheels, in dist/packages
	$(PY) scripts/package build $(ZIP) $(ARGS)
	cd dist/packages && sha256sum cubic_craft-* >SHA256SUMS

upload: setup $(ZIP) ## Those for the extensions platform, in dist/upload
	$(PY) scripts/package upload $(ZIP)

repository: package ## Those as an extension repository for any web server, in dist/repository
	$(PY) scripts/package repository dist/packages/*.zip

release: package wheel ## All that is published of a version, with checksums, in dist/release
	rm -rf dist/release
	mkdir dist/release
	cp dist/packages/cubic_craft-* dist/cubic_craft-*.whl dist/cubic_craft-*.tar.gz dist/release
	cd dist/release && sha256sum cubic_craft-* >SHA256SUMS

wheel: $(VENV)-wheel/.done ## The solver as a wheel for pip, without Blender, in dist
	rm -f dist/cubic_craft-*.whl dist/cubic_craft-*.tar.gz
	$(VENV)-wheel/bin/python -m build --no-isolation --outdir dist

$(VENV)-wheel/.done: requirements/wheel.txt
	$(PYTHON) -m venv --clear $(VENV)-wheel
	$(VENV)-wheel/bin/python $(PIP) -r $<
	@touch $@

# In a new environment: its name, its Python, its requirements, the extra of the wheel, the tests.
define test_library
$(2) -m venv --clear $(VENV)-library-$(1)
$(VENV)-library-$(1)/bin/python $(PIP) -r requirements/library-$(3).txt "$$(echo dist/cubic_craft-*.whl)$(4)"
$(if $(4),$(call compile_taichi,$(VENV)-library-$(1)))
$(VENV)-library-$(1)/bin/python -m pip check
$(VENV)-library-$(1)/bin/python $(PYTEST) $(5)
endef
NOTEBOOK := tests/library/test_library_notebook.py

test-wheel: wheel ## The installed wheel with the oldest and the newest NumPy, its command and the notebook
	$(call test_library,oldest,$(PYTHON311),oldest,,--few 2 --ignore $(NOTEBOOK) tests/library)
	$(call test_library,newest,$(PYTHON),newest,[fast],tests/library)

# Of each lock: a platform, a Python, and the oldest NumPy of a Blender that has it. The solver needs the
# same on all platforms but Arm, so one lock is for Python 3.11 and 3.13 everywhere.
define write_lock
echo numpy==$(4) | $(PY) -m uv pip compile --quiet --upgrade --no-header --no-annotate --generate-hashes \
	--only-binary :all: --no-emit-package numpy --python-platform $(2)-manylinux_2_28 --python-version $(3) \
	--constraints - requirements/solver.txt --output-file requirements/$(1).lock
endef

lock: setup ## Choose the wheels of the packages anew: requirements/wheels*.lock
	$(PY) $(PIP) uv==0.13.9
	$(call write_lock,wheels,x86_64,3.11,1.24.3)
	$(call write_lock,wheels_linux-x64_python3.14,x86_64,3.14,2.3.4)
	$(call write_lock,wheels_linux-arm64_python3.14,aarch64,3.14,2.3.4)

bench: setup ## Side by side with other programs; writes docs/benchmarks.md
	$(PY) $(PIP) -r requirements/bench.txt
	$(PY) scripts/benchmark $(ARGS)

bench-quick: setup ## A part of it in about two minutes; writes build/bench
	$(PY) $(PIP) -r requirements/bench.txt
	$(PY) scripts/benchmark --quick $(ARGS)

docs: $(VENV)-docs/.done ## The documentation as a site, build/site/index.html; SITE_URL=where it will lie
	NO_MKDOCS_2_WARNING=1 SITE_URL="$(SITE_URL)" $(VENV)-docs/bin/python -m mkdocs build

$(VENV)-docs/.done: requirements/docs.txt
	$(PYTHON) -m venv --clear $(VENV)-docs
	$(VENV)-docs/bin/python $(PIP) -r requirements/docs.txt
	@touch $@

.PHONY: figures
figures: setup ## The figures of the paper, in docs/figures; MESHES=folder, else Blender's own shapes
	$(PY) scripts/figures $(if $(MESHES),--meshes "$(MESHES)") $(ARGS)

.PHONY: small-pictures
small-pictures: setup ## Those in the panel; KIND=presets or forms
	$(PY) scripts/small_pictures $(KIND) $(ARGS)

example-pictures: setup $(ZIP) ## The pictures of docs/examples.md, in docs/images
	CUBIC_CRAFT_ZIP=$(ZIP) CUBIC_CRAFT_PICTURES=docs/images \
		$(PY) $(PYTEST) --thorough tests/blender/test_examples.py

films: $(ZIP) ## Films of README and docs/, taken in real Blender windows
	TESTS="film_*" tests/gui/run.sh $(ZIP)
	cp build/gui/trixie/film_live/live.gif build/gui/sid/film_follow/follow.gif docs/images/

docs-images: $(ZIP) ## Pictures of docs/: those of the user guide, and those of the last window tests
	TESTS="pictures_*" tests/gui/run.sh $(ZIP) build/gui/pictures trixie
	cp build/gui/trixie/test_first_sculpture/first_*.png docs/images/
	cp build/gui/pictures/trixie/pictures_user_guide/user_guide_*.png docs/images/
	cp build/gui/trixie/test_handles/posed.png docs/images/handles_window.png
	cp build/gui/trixie/test_live_gizmos/gizmo.png docs/images/handles_gizmo.png

clean: ## Remove what has been built, not the virtual environments
	rm -rf build dist
