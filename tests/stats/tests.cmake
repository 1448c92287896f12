foreach(name nist_test image_metrics_test statistics_test invariants_test extremes_test counts_test tables_test resampling_test
        signals_test published_data_test)
  vis2hap_test(stats ${name} LINK stats nlohmann_json::nlohmann_json)
endforeach()
vis2hap_test(stats oracle_test LINK study_commands)
foreach(name mixed_model_test logistic_mixed_model_test power_test calibration_test)
  vis2hap_test(stats ${name} LINK stats nlohmann_json::nlohmann_json)
endforeach()
