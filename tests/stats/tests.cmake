foreach(name oracle_test nist_test image_metrics_test statistics_test)
  vis2hap_test(stats ${name} LINK stats nlohmann_json::nlohmann_json)
endforeach()
