# `cpack` makes Debian packages, one per component. The preset `package` builds what belongs into them.
set(SLOPEMIX_MAINTAINER "slopemix maintainers <maintainers@users.noreply.h-seed-d38a157f.example>"
    CACHE STRING "Maintainer of the packages, NAME <ADDRESS>")
set(SLOPEMIX_DEBIAN_REVISION 1 CACHE STRING "What stands behind the version in the packages' own")
set(debian_version ${PROJECT_VERSION}-${SLOPEMIX_DEBIAN_REVISION})
set(debian_library libslopemix${PROJECT_VERSION_MAJOR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME slopemix)
set(CPACK_PACKAGE_CONTACT ${SLOPEMIX_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
    WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL library development)
if(SLOPEMIX_BUILD_TOOLS)
  list(APPEND CPACK_COMPONENTS_ALL tools)
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${SLOPEMIX_DEBIAN_REVISION})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/lib)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")

# Under one synopsis; lines of at most 80 characters.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "measured materials on surfaces that are rough below the pixel")
set(what_it_does "slopemix turns a measured BRDF into a mixture of Beckmann slope lobes, widens
every lobe by the roughness of a displaced surface, and shades with one
evaluation per pixel.
.
")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${debian_library})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd")
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "${what_it_does}This package holds the shared library. It needs an OpenCL device, such as
PoCL's, for all but fitting.")
# dpkg runs ldconfig by this; the scripts that cpack adds run it too.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_SOURCE_DIR}/triggers)

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libslopemix-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${debian_library} (= ${debian_version})")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS opencl-headers) # for slopemix_opencl.h
if(SLOPEMIX_STATIC)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", ocl-icd-opencl-dev, libopenexr-dev, libpng-dev, "
         "libssl-dev, libkissfft-dev, libceres-dev")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "${what_it_does}This package holds the C headers, the headers for kernels in OpenCL C, and
what CMake and pkg-config need.")

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME slopemix)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "${debian_library} (>= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS fonts-dejavu-core)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS gnuplot-nox)
set(CPACK_DEBIAN_TOOLS_DESCRIPTION "${what_it_does}This package holds the command that fits, renders and measures.")

# Changelog and compression, as Debian's policy wants them.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_BINARY_DIR}/debian_documents.cmake)
configure_file(debian_documents.cmake.in debian_documents.cmake @ONLY)

include(CPack)
