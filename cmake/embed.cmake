# Embeds files in the program, as the function
#   std::map<std::string, std::string_view, std::less<>> const& rois::files::FUNCTION();

# source_with_files(VARIABLE FUNCTION FOLDER FILE...): sets VARIABLE to the text of a source that defines FUNCTION, which maps the path of
# each file in FOLDER to its bytes.
function(source_with_files variable function folder)
    set(text "// Made by cmake/embed.cmake.\n#include \"files/files.hpp\"\n\n")
    set(entries "")
    set(number 0)
    foreach(file IN LISTS ARGN)
        cmake_path(RELATIVE_PATH file BASE_DIRECTORY ${folder} OUTPUT_VARIABLE name)
        set(symbol "rois_${function}_${number}")
        # ccache hashes the source, not the files of .incbin. So the source contains the hash of each file.
        file(SHA1 ${file} hash)
        string(APPEND text "asm(\".section .rodata /* ${hash} */\\n${symbol}:\\n.incbin \\\"${file}\\\"\\n${symbol}_end:\\n.byte 0\\n.previous\\n\");\n"
            "extern \"C\" const char ${symbol}[] __attribute__((visibility(\"hidden\")));\n"
            "extern \"C\" const char ${symbol}_end[] __attribute__((visibility(\"hidden\")));\n")
        string(APPEND entries "        {\"${name}\", {${symbol}, ${symbol}_end}},\n")
        math(EXPR number "${number} + 1")
    endforeach()
    string(APPEND text "\nnamespace rois::files {\n\nNamed const& ${function}() {\n    static Named const files{\n${entries}    };\n"
        "    return files;\n}\n\n}  // namespace rois::files\n")
    set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# embed_source(TARGET SOURCE FILE...): compiles a source with files into TARGET.
function(embed_source target source)
    set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${ARGN}" COMPILE_OPTIONS "-fno-lto")
    target_sources(${target} PRIVATE ${source})
endfunction()

# embed_files(TARGET FUNCTION FOLDER FILE...): the same for files that exist when CMake runs.
function(embed_files target function folder)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded_${function}.cpp)
    source_with_files(text ${function} ${folder} ${ARGN})
    file(GENERATE OUTPUT ${source} CONTENT "${text}")
    embed_source(${target} ${source} ${ARGN})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ARGN})
endfunction()
