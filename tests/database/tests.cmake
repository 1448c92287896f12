# What tests of studies share: a small study, a played session, a failing disk, a second process.
add_library(tests_support STATIC support/study_builder.cpp support/played_session.cpp support/counting_vfs.cpp)
target_link_libraries(tests_support PUBLIC vis2hap_rules study_session database rendering_images protocols SQLite::SQLite3)

add_executable(session_child support/session_child.cpp)
set_target_properties(session_child PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
target_link_libraries(session_child PRIVATE tests_support)

vis2hap_test(database study_store_test LINK tests_support)
add_dependencies(study_store_test session_child)
vis2hap_test(database durability_test LINK tests_support)
vis2hap_test(database keys_test LINK tests_support)
