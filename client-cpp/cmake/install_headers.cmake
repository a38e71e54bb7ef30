# Installs the public headers: the client's under rois/, the messages' under rois/types/, the C++ PSM's under rois/psm/. Adapts
# their #include lines. Usage: cmake -DSOURCE=... -DDESTINATION=... -P install_headers.cmake
function(install_headers from pattern to)
    file(GLOB headers ${from}/${pattern})
    foreach(header IN LISTS headers)
        get_filename_component(name ${header} NAME)
        file(READ ${header} text)
        string(REPLACE "#include \"types/" "#include \"rois/types/" text "${text}")
        string(REGEX REPLACE "#include \"(rois/[^\"]+)\"" "#include <\\1>" text "${text}")
        file(WRITE ${to}/${name} "${text}")
    endforeach()
endfunction()

install_headers(${SOURCE}/client-cpp/include/rois *.hpp ${DESTINATION}/rois)
install_headers(${SOURCE}/client-cpp/include/rois/psm *.hpp ${DESTINATION}/rois/psm)
install_headers(${SOURCE}/server/types *.hpp ${DESTINATION}/rois/types)
