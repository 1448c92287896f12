foreach(test training_test generation_test weights_test)
  vis2hap_test(rendering ${test} LINK rendering_generation rendering_fabrics protocols)
  add_dependencies(${test} vis2hap-nn)
endforeach()
