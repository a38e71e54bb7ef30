# embed_files(TARGET FUNCTION FILE...): adds to TARGET a source that defines
#   std::map<std::string, std::string_view, std::less<>> const& rois::files::FUNCTION();
# which maps the name of each file (without its folder) to its bytes, inside the program.
function(embed_files target function)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded_${function}.cpp)
    set(text "// Made by cmake/embed.cmake.\n#include \"files/files.hpp\"\n\n")
    set(entries "")
    set(number 0)
    foreach(file IN LISTS ARGN)
        get_filename_component(name ${file} NAME)
        set(symbol "rois_${function}_${number}")
        string(APPEND text "asm(\".section .rodata\\n${symbol}:\\n.incbin \\\"${file}\\\"\\n${symbol}_end:\\n.byte 0\\n.previous\\n\");\n"
            "extern \"C\" const char ${symbol}[] __attribute__((visibility(\"hidden\")));\n"
            "extern \"C\" const char ${symbol}_end[] __attribute__((visibility(\"hidden\")));\n")
        string(APPEND entries "        {\"${name}\", {${symbol}, ${symbol}_end}},\n")
        math(EXPR number "${number} + 1")
    endforeach()
    string(APPEND text "\nnamespace rois::files {\n\nNamed const& ${function}() {\n    static Named const files{\n${entries}    };\n"
        "    return files;\n}\n\n}  // namespace rois::files\n")
    file(GENERATE OUTPUT ${source} CONTENT "${text}")
    set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${ARGN}" COMPILE_OPTIONS "-fno-lto")
    # A ccache that hashes the source alone would miss a changed .incbin; the files' bytes go into the command line.
    set(hashes "")
    foreach(file IN LISTS ARGN)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
        file(SHA1 ${file} hash)
        string(APPEND hashes ${hash})
    endforeach()
    string(SHA1 hash "${hashes}")
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS "ROIS_EMBEDDED=${hash}")
    target_sources(${target} PRIVATE ${source})
endfunction()
