# The front door. The build itself is CMake's; see CMakePresets.json.

.PHONY: all demo check check-peers bench dropin horizon-results figures clean help

all:
	@tools/setup.sh build
	@cmake --preset release --log-level=WARNING >/dev/null
	@cmake --build --preset release --target lobe lobe_static lobe_shared

demo: all
	@tools/demo.sh

check:
	@tools/setup.sh check
	@tools/check.sh

check-peers: all
	@tools/setup.sh peers
	@tools/check_peers.sh

bench: all
	@build/lobe bench

dropin:
	@tools/dropin.sh build/dropin

horizon-results: all
	@cc -O2 -Iinclude tools/numerics/furnace_variance.c build/liblobe.a -lm -o build/furnace_variance
	@tools/horizon_results.py

figures: all
	@tools/figures.sh

clean:
	rm -rf build

help:
	@echo "make         build/lobe, build/liblobe.a and build/liblobe.so"
	@echo "make demo    render pictures and compare the methods"
	@echo "make check   every build, check and test"
	@echo "make check-peers  our pictures against those of Mitsuba 3 (from the Python package index)"
	@echo "make bench   time every sampler against its published listing"
	@echo "make dropin  samplers as single files of C, GLSL and HLSL; shaders as SPIR-V"
	@echo "make horizon-results  measure docs/horizon-results.md (needs python3-numpy)"
	@echo "make figures  draw every figure of the papers into docs/figures"
	@echo "make clean   remove build/"
