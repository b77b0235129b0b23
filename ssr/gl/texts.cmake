# LOBE_SSR_TEXTS: the texts of the shaders as a C file.
set(LOBE_SSR_TEXTS ${CMAKE_CURRENT_BINARY_DIR}/texts.c)
set(texts common=ssr/shaders/common.glsl)
foreach(name ndf slope_published slope ellipsoid caps bounded optimal horizon_mirror horizon_exact horizon_uniform
        horizon)
    list(APPEND texts ggx_${name}=kernel/ggx_${name}.h)
endforeach()
foreach(name depth halve_depth halve_color trace reproject resolve accumulate keep_z composite)
    list(APPEND texts ${name}=ssr/shaders/${name}.comp)
endforeach()
list(APPEND texts draw_mirror=ssr/shaders/draw_mirror.glsl draw_lobe=ssr/shaders/draw_lobe.glsl)
list(JOIN texts "," texts)
file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/kernel/*.h ${PROJECT_SOURCE_DIR}/kernel/bind/*.h
     ${CMAKE_CURRENT_SOURCE_DIR}/passes/*.h ${CMAKE_CURRENT_SOURCE_DIR}/shaders/*)
add_custom_command(
    OUTPUT ${LOBE_SSR_TEXTS}
    COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -DOUT=${LOBE_SSR_TEXTS} -DSYMBOL=lobe_ssr_texts -DTEXTS=${texts}
            -P ${CMAKE_CURRENT_SOURCE_DIR}/gl/embed.cmake
    DEPENDS ${sources} ${CMAKE_CURRENT_SOURCE_DIR}/gl/embed.cmake
    COMMENT "Embedding the shaders"
    VERBATIM)
