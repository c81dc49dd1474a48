// write_expected DIR: prints what this version reads in a folder of its files, for tools/keep-formats.
#include <gtest/gtest.h>

#include <iostream>

#include "kept_files.h"

int main(int argc, char **argv) {
    testing::InitGoogleTest(&argc, argv);
    if (argc != 2) {
        std::cerr << "usage: write_expected DIR\n";
        return 2;
    }
    std::cout << test::read_kept_files(argv[1]).dump(1) << '\n';
    return testing::UnitTest::GetInstance()->Failed() ? 1 : 0;
}
