# What `cmake --install` puts into a prefix, by component: `library` (headers, archives, CMake's package,
# examples), `program` (with scenes and docs). The libraries of the system that the program needs (`bundled`) go into the
# archive of `cpack -G TGZ` alone, which runs where it is unpacked, on any Linux of that processor as new as the one that
# built it; libc and OpenGL stay outside.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The robotics library `pinocchio` may be in the same prefix: its headers are include/pinocchio/NAME.hpp, its libraries
# lib/libpinocchio_NAME.so and its CMake package is lib/cmake/pinocchio (tests/consumer/robotics_pinocchio.txt). No file
# or folder of ours has one of those names, also where the file system ignores case.
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/PinocchioRenderer)
set(header_folder ${CMAKE_INSTALL_INCLUDEDIR}/pinocchio-renderer)
# An export file for each component of find_package(PinocchioRenderer).
set(core_targets pinocchio_core)
set(compare_targets pinocchio_compare)
set(pinocchio_targets pinocchio_glad pinocchio_gl pinocchio_reference pinocchio_hybrid)
foreach(name core compare pinocchio)
  install(TARGETS ${${name}_targets} EXPORT ${name}_export COMPONENT library
          FILE_SET HEADERS DESTINATION ${header_folder} COMPONENT library)
  install(EXPORT ${name}_export FILE ${name}.cmake NAMESPACE Pinocchio:: DESTINATION ${config_folder} COMPONENT library)
endforeach()
configure_package_config_file(cmake/PinocchioRendererConfig.cmake.in ${PROJECT_BINARY_DIR}/PinocchioRendererConfig.cmake
                              INSTALL_DESTINATION ${config_folder})
# find_package(Pinocchio) looks in this folder as well: it finds the same package.
file(WRITE ${PROJECT_BINARY_DIR}/PinocchioConfig.cmake
     "include(\${CMAKE_CURRENT_LIST_DIR}/PinocchioRendererConfig.cmake)\n")
foreach(name PinocchioRenderer Pinocchio)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/${name}ConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/${name}Config.cmake ${PROJECT_BINARY_DIR}/${name}ConfigVersion.cmake
          DESTINATION ${config_folder} COMPONENT library)
endforeach()
install(DIRECTORY examples DESTINATION share/doc/pinocchio COMPONENT library)

install(TARGETS pinocchio RUNTIME_DEPENDENCY_SET pinocchio_libraries DESTINATION bin COMPONENT program)
install(DIRECTORY scenes DESTINATION share/pinocchio COMPONENT program PATTERN generator EXCLUDE)
install(FILES bench/chart/charts.py bench/chart/explore.html bench/chart/overview.py bench/chart/plot.py DESTINATION share/pinocchio/chart COMPONENT program)
install(FILES README.md LICENSE CHANGELOG.md CONTRIBUTING.md DESTINATION share/doc/pinocchio COMPONENT program)
install(DIRECTORY docs DESTINATION share/doc/pinocchio COMPONENT program)

# The man page and the shells' completions are made from the program's --help.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(help_files ${PROJECT_BINARY_DIR}/help/pinocchio.1 ${PROJECT_BINARY_DIR}/help/pinocchio.bash ${PROJECT_BINARY_DIR}/help/_pinocchio)
add_custom_command(OUTPUT ${help_files}
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/cmake/from_help.py ${PINOCCHIO_RUN} ${PROJECT_BINARY_DIR}/help
  DEPENDS pinocchio ${PROJECT_SOURCE_DIR}/cmake/from_help.py VERBATIM)
add_custom_target(help_files ALL DEPENDS ${help_files})
install(FILES ${PROJECT_BINARY_DIR}/help/pinocchio.1 DESTINATION share/man/man1 COMPONENT program)
install(FILES ${PROJECT_BINARY_DIR}/help/pinocchio.bash DESTINATION share/bash-completion/completions RENAME pinocchio COMPONENT program)
install(FILES ${PROJECT_BINARY_DIR}/help/_pinocchio DESTINATION share/zsh/site-functions COMPONENT program)
install(DIRECTORY farm DESTINATION share/doc/pinocchio USE_SOURCE_PERMISSIONS COMPONENT program)

install(RUNTIME_DEPENDENCY_SET pinocchio_libraries
        PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|rt|pthread)\\.so" "^lib(GL|EGL|OpenGL|GLX|OSMesa)"
        LIBRARY DESTINATION lib COMPONENT bundled EXCLUDE_FROM_ALL)
# The program finds bundled libraries beside it, and they each other.
set_target_properties(pinocchio PROPERTIES INSTALL_RPATH "$ORIGIN/../lib")
# RPATH, not RUNPATH: it also holds for libraries of libraries.
target_link_options(pinocchio PRIVATE -Wl,--disable-new-dtags)

set(CPACK_GENERATOR TGZ DEB)
set(CPACK_PACKAGE_FILE_NAME pinocchio-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program bundled)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_COMPONENT_INCLUDE_TOPLEVEL_DIRECTORY ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_STRIP_FILES ON)
# The .deb takes its libraries from Debian; OpenGL is opened at run time, so that no linker names it.
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/package_deb.cmake)
set(CPACK_PACKAGE_CONTACT "The Pinocchio authors <pinocchio@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Hybrid renderer: a CPU ray tracer and OpenGL share every frame")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libegl1, libgl1-mesa-dri")
if(CMAKE_CROSSCOMPILING)  # no package of that architecture is installed: who packs names the libraries (scripts/test-arm64)
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64)
else()
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
endif()
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libosmesa6, python3-matplotlib")
include(CPack)
