# embed.cmake: the files of a folder as a C source file.
#
#     cmake -DSITE=FOLDER -DOUTPUT=page.c -P embed.cmake
#
# SITE may be empty: then there is no page.
cmake_policy(VERSION 3.25)
set(names)
if(SITE)
    file(GLOB_RECURSE names RELATIVE ${SITE} ${SITE}/*)
    list(SORT names)
    if(NOT "index.html" IN_LIST names)
        message(FATAL_ERROR "${SITE}: there is no index.html")
    endif()
endif()

set(text "#include \"page.h\"\n\n")
set(rows)
set(count 0)
foreach(name IN LISTS names)
    file(READ ${SITE}/${name} bytes HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
    # One byte more: a file may be empty, an array may not.
    string(APPEND text "static const unsigned char file_${count}[] = {${bytes}0};\n")
    string(APPEND rows "    {\"${name}\", file_${count}, sizeof file_${count} - 1},\n")
    math(EXPR count "${count} + 1")
endforeach()
if(count EQUAL 0)
    set(rows "    {0}\n")
endif()
string(APPEND text "\nconst page_file lobe_page_files[] = {\n${rows}};\n"
    "const int lobe_page_count = ${count};\n")
file(WRITE ${OUTPUT} "${text}")
