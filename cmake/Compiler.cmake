# How every file of the tree is compiled.

if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug" FORCE)
endif()
set(CMAKE_C_FLAGS_RELEASE "-O2 -DNDEBUG")

set(CMAKE_C_STANDARD 17)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_C_VISIBILITY_PRESET hidden)

# C++ stands before libraries that have no C interface, nowhere else.
set(CMAKE_CXX_FLAGS_RELEASE "${CMAKE_C_FLAGS_RELEASE}")
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)

set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# The same bits from every compiler and on every processor: no contraction to fused multiply-add.
# Nothing reads errno or the exception flags of a floating-point operation, and both stop
# vectorisation and inline square roots.
add_compile_options(-ffp-contract=off -fno-math-errno -fno-trapping-math)

add_compile_options(-Wall -Wextra -Wpedantic
                    $<$<COMPILE_LANGUAGE:C>:-Wstrict-prototypes> $<$<COMPILE_LANGUAGE:C>:-Wmissing-prototypes>)
# Of loops that become vectors, and of those that must not.
# gcc vectorises a loop only if its selections are still selections by then: these passes turn them
# into jumps; and if its structures have become single numbers, however large they are. Their long chains of
# results that wait for each other are scheduled before registers are given out, too. Scalar is scalar:
# what the tests compare with; there -ftree-pre costs half of the compile time and gains nothing.
if(CMAKE_C_COMPILER_ID STREQUAL "GNU")
    set(LOBE_VECTOR_FLAGS "-O3;-fno-thread-jumps;-fno-tree-pre;-fno-unswitch-loops;--param=sra-max-propagations=1000;-fschedule-insns;-fsched-pressure")
    set(LOBE_SCALAR_FLAGS "-fno-tree-vectorize;-fno-tree-pre")
else()
    set(LOBE_VECTOR_FLAGS "-O3")
    set(LOBE_SCALAR_FLAGS "-fno-vectorize;-fno-slp-vectorize")
endif()

if(LOBE_WERROR)
    add_compile_options(-Werror)
endif()

if(LOBE_SANITIZE)
    # -O1: with -O0 the statistical tests take minutes.
    add_compile_options(-O1 -g -fno-omit-frame-pointer
                        -fsanitize=address,undefined -fno-sanitize-recover=all)
    add_link_options(-fsanitize=address,undefined)
endif()

if(LOBE_COVERAGE)
    add_compile_options(-O0 -g --coverage)
    add_link_options(--coverage)
endif()
