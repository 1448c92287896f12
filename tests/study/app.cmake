# The window, driven through its real widgets.
add_library(tests_window STATIC support/open_window.cpp support/typed_answers.cpp support/whole_protocol.cpp)
target_link_libraries(tests_window PUBLIC study_app tests_support Qt6::Test)
foreach(name app_test app_stages_test app_answers_test app_operator_test app_pages_test app_faults_test app_monitor_test
             app_cover_test app_looks_test)
  vis2hap_test(study ${name} LINK tests_window)
endforeach()
vis2hap_test(study app_blinding_test LINK tests_window tests_program)
add_dependencies(app_blinding_test vis2hap)
vis2hap_test(study app_data_test LINK tests_window study_commands)
vis2hap_test(study app_display_test LINK tests_window)
add_dependencies(app_display_test vis2hap-reference-display)
target_compile_definitions(app_display_test PRIVATE VIS2HAP_REFERENCE_DISPLAY="${PROJECT_BINARY_DIR}/vis2hap-reference-display")
