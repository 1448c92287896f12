vis2hap_test(study analyse_test LINK study_commands)
