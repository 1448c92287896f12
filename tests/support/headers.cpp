// Nothing of its own: its target compiles the headers that the tests share (tests/CMakeLists.txt).
