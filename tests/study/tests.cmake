vis2hap_test(study session_test LINK study_session)
vis2hap_test(study driver_test LINK tests_support)
vis2hap_test(study killed_session_test LINK tests_support)
add_dependencies(killed_session_test session_child)
