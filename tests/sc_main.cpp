#include <gtest/gtest.h>

#include <systemc>

// libsystemc owns main(); a test program's own entry is sc_main.
int sc_main(int argc, char** argv) {
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
