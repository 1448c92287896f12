foreach(name results_test reference_report_test answers_csv_test report_files_test csv_fuzz_test)
  vis2hap_test(reports ${name} LINK reports)
endforeach()
