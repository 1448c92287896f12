# The window, driven through its real widgets.
add_library(tests_window STATIC support/open_window.cpp support/typed_answers.cpp)
target_link_libraries(tests_window PUBLIC study_app tests_support Qt6::Test)
foreach(name app_test app_operator_test app_pages_test app_looks_test app_blinding_test)
  vis2hap_test(study ${name} LINK tests_window)
endforeach()
