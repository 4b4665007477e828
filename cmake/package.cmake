# cpack -G TGZ: an archive that runs where it is unpacked, on any x86-64 Linux as new as the one that built
# it: program, shaders, scenes, and the libraries it needs beside it, except libc and OpenGL.
install(TARGETS pinocchio RUNTIME_DEPENDENCY_SET pinocchio_libraries DESTINATION bin)
install(RUNTIME_DEPENDENCY_SET pinocchio_libraries
        PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|rt|pthread)\\.so" "^lib(GL|EGL|OpenGL|GLX|OSMesa)"
        DESTINATION lib)
install(DIRECTORY shaders scenes DESTINATION share/pinocchio PATTERN generator EXCLUDE)
install(FILES bench/chart/charts.py bench/chart/plot.py DESTINATION share/pinocchio/chart)
install(FILES README.md LICENSE CHANGELOG.md DESTINATION share/doc/pinocchio)
# What is installed finds its libraries beside it, and they each other.
set_target_properties(pinocchio PROPERTIES INSTALL_RPATH "$ORIGIN/../lib")
# RPATH, not RUNPATH: it also holds for libraries of libraries.
target_link_options(pinocchio PRIVATE -Wl,--disable-new-dtags)

set(CPACK_GENERATOR TGZ)
set(CPACK_PACKAGE_FILE_NAME pinocchio-${PROJECT_VERSION}-linux-x86_64)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_STRIP_FILES ON)
include(CPack)
