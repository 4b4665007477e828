# pinocchio_settings: what every target of ours is compiled with. Linked PRIVATE, so nothing leaks to
# a consumer and no global flag is set.
find_package(Boost REQUIRED)
find_package(nlohmann_json REQUIRED)
add_library(pinocchio_settings INTERFACE)
# Headers alone: who links our archives needs neither.
target_link_libraries(pinocchio_settings INTERFACE Boost::headers nlohmann_json::nlohmann_json)
target_compile_features(pinocchio_settings INTERFACE cxx_std_20)
target_include_directories(pinocchio_settings INTERFACE ${PROJECT_SOURCE_DIR})
# No silent contraction: a*b+c is two roundings on every machine, or the picture would depend on
# which machine drew it.
target_compile_options(pinocchio_settings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -ffp-contract=off
                       # GCC 12 sees overlaps in std::string that there are not (its bug 105651).
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
                       $<$<BOOL:${PINOCCHIO_WARNINGS_AS_ERRORS}>:-Werror>)
target_compile_definitions(pinocchio_settings INTERFACE GLM_FORCE_EXPLICIT_CTOR)
# GCC collects garbage often by default: 13 % of the time of our larger files, for memory that developers have.
target_compile_options(pinocchio_settings INTERFACE
                       $<$<AND:$<CXX_COMPILER_ID:GNU>,$<CONFIG:RelWithDebInfo>>:--param=ggc-min-heapsize=1000000>)
# Linked as well by what is timed (bench), which happens in Release: elsewhere optimising it takes longer than it ever saves.
add_library(pinocchio_timed INTERFACE)
target_compile_options(pinocchio_timed INTERFACE $<$<CONFIG:RelWithDebInfo>:-Og>)
# Linked as well by what nobody waits for (verbs, panels, tests), where that is so in Release, too.
add_library(pinocchio_cold INTERFACE)
target_link_libraries(pinocchio_cold INTERFACE pinocchio_timed)
target_compile_options(pinocchio_cold INTERFACE $<$<CONFIG:Release>:-O1>)
if(PINOCCHIO_SANITIZE)
  target_compile_options(pinocchio_settings INTERFACE -fsanitize=${PINOCCHIO_SANITIZE} -fno-sanitize-recover=all
                         -fno-omit-frame-pointer)
  target_link_options(pinocchio_settings INTERFACE -fsanitize=${PINOCCHIO_SANITIZE})
endif()
