# Writes the bill of materials of a program as SPDX 2.3 in JSON: the packages of Debian whose code it contains or loads, and the npm
# packages of the console.
#   cmake -DPROGRAM=FILE -DVERSION=V -DCONTAINS=PACKAGES -DLOCK=package-lock.json -DOUT=FILE -P sbom.cmake
cmake_minimum_required(VERSION 3.25)

file(SHA256 ${PROGRAM} hash)
string(TIMESTAMP now UTC)  # or that of SOURCE_DATE_EPOCH
set(sbom [[{"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "packages": [], "relationships": []}]])

# set_in(<list of keys> <JSON>): sets a member of the document.
macro(set_in keys json)
    string(JSON sbom SET "${sbom}" ${keys} "${json}")
endmacro()

# add_package(<name> <version> <license> <URL of the package> <relationship>): to the document, as used by the program.
set(count 0)
function(add_package name version license purl relationship)
    string(REGEX REPLACE "[^A-Za-z0-9.-]" "-" id "SPDXRef-${name}")
    set(package "{\"SPDXID\": \"${id}\", \"name\": \"${name}\", \"versionInfo\": \"${version}\", \"downloadLocation\": \"NOASSERTION\", \"filesAnalyzed\": false,
        \"licenseConcluded\": \"NOASSERTION\", \"licenseDeclared\": \"${license}\", \"copyrightText\": \"NOASSERTION\"}")
    if(purl)
        string(JSON package SET "${package}" externalRefs
            "[{\"referenceCategory\": \"PACKAGE-MANAGER\", \"referenceType\": \"purl\", \"referenceLocator\": \"${purl}\"}]")
    endif()
    if(relationship STREQUAL "DESCRIBES")
        set(relation "{\"spdxElementId\": \"SPDXRef-DOCUMENT\", \"relationshipType\": \"DESCRIBES\", \"relatedSpdxElement\": \"${id}\"}")
    else()
        set(relation "{\"spdxElementId\": \"SPDXRef-rois-gateway\", \"relationshipType\": \"${relationship}\", \"relatedSpdxElement\": \"${id}\"}")
    endif()
    string(JSON sbom SET "${sbom}" packages ${count} "${package}")
    string(JSON sbom SET "${sbom}" relationships ${count} "${relation}")
    math(EXPR count "${count} + 1")
    set(sbom "${sbom}" PARENT_SCOPE)
    set(count ${count} PARENT_SCOPE)
endfunction()

set_in("name" "\"rois-gateway-${VERSION}\"")
set_in("documentNamespace" "\"https://spdx.org/spdxdocs/rois-gateway-${VERSION}-${hash}\"")
set_in("creationInfo" "{\"created\": \"${now}\", \"creators\": [\"Tool: CMake-${CMAKE_VERSION}\"]}")
add_package(rois-gateway ${VERSION} Apache-2.0 "" DESCRIBES)

# Adds packages of Debian that are installed.
function(add_debian_packages relationship)
    execute_process(COMMAND dpkg-query -W -f "\${Package} \${Version} \${Architecture}\n" ${ARGN} OUTPUT_VARIABLE found ERROR_QUIET)
    string(REGEX MATCHALL "[^\n]+" found "${found}")
    foreach(line IN LISTS found)
        string(REPLACE " " ";" line ${line})
        list(POP_FRONT line name version architecture)
        string(REPLACE "+" "%2B" in_url ${version})
        string(REPLACE ":" "%3A" in_url ${in_url})
        add_package(${name} ${version} NOASSERTION "pkg:deb/debian/${name}@${in_url}?arch=${architecture}" ${relationship})
    endforeach()
    set(sbom "${sbom}" PARENT_SCOPE)
    set(count ${count} PARENT_SCOPE)
endfunction()

# Shared libraries, by the packages of their files. /lib is a link to /usr/lib, and the database has one of the two names.
execute_process(COMMAND ldd ${PROGRAM} OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "/[^ \n]+[.]so[^ \n]*" libraries "${libraries}")
set(names)
foreach(library IN LISTS libraries)
    file(REAL_PATH ${library} real)
    string(REGEX REPLACE "^/usr" "" short ${real})
    list(APPEND names ${real} ${short})
endforeach()
execute_process(COMMAND dpkg-query -S ${names} OUTPUT_VARIABLE owners ERROR_QUIET)
string(REGEX MATCHALL "[^\n]+" owners "${owners}")
list(TRANSFORM owners REPLACE ":.*" "")
list(REMOVE_DUPLICATES owners)
add_debian_packages(DYNAMIC_LINK ${owners})
add_debian_packages(STATIC_LINK ${CONTAINS})

# The npm packages that the console contains: those of the lock file that are not only for development.
if(LOCK)
    file(READ ${LOCK} lock)
    string(JSON last LENGTH "${lock}" packages)
    math(EXPR last "${last} - 1")
    foreach(i RANGE ${last})
        string(JSON path MEMBER "${lock}" packages ${i})
        string(JSON for_development ERROR_VARIABLE none GET "${lock}" packages "${path}" dev)
        string(JSON is_ours ERROR_VARIABLE none GET "${lock}" packages "${path}" link)
        if(path MATCHES "^node_modules/(.+)" AND NOT for_development STREQUAL "ON" AND NOT is_ours STREQUAL "ON")
            set(name ${CMAKE_MATCH_1})
            string(JSON version GET "${lock}" packages "${path}" version)
            string(JSON license ERROR_VARIABLE none GET "${lock}" packages "${path}" license)
            string(REPLACE "@" "%40" in_url ${name})
            add_package(${name} ${version} "${license}" "pkg:npm/${in_url}@${version}" CONTAINS)
        endif()
    endforeach()
endif()

file(WRITE ${OUT} "${sbom}\n")
