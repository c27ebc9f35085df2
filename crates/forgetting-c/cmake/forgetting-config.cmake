# find_package(forgetting) gives forgetting::forgetting (shared) and forgetting::static.
get_filename_component(_forgetting_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

if(NOT TARGET forgetting::forgetting)
  add_library(forgetting::forgetting SHARED IMPORTED)
  set_target_properties(forgetting::forgetting PROPERTIES
    IMPORTED_LOCATION "${_forgetting_prefix}/lib/libforgetting.so"
    IMPORTED_SONAME "libforgetting.so.0"
    INTERFACE_INCLUDE_DIRECTORIES "${_forgetting_prefix}/include")

  add_library(forgetting::static STATIC IMPORTED)
  set_target_properties(forgetting::static PROPERTIES
    IMPORTED_LOCATION "${_forgetting_prefix}/lib/libforgetting.a"
    INTERFACE_LINK_LIBRARIES "m"
    INTERFACE_INCLUDE_DIRECTORIES "${_forgetting_prefix}/include")
endif()

unset(_forgetting_prefix)
