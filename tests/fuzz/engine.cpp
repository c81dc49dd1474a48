// With libFuzzer: `fuzz_NAME --seeds=DIR` writes the seeds as files and ends.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "files.h"
#include "target.h"

extern "C" int LLVMFuzzerInitialize(int *argc, char ***argv) {
    constexpr const char *flag = "--seeds=";
    for (int k = 1; k < *argc; ++k) {
        if (std::strncmp((*argv)[k], flag, std::strlen(flag)) != 0) continue;
        const std::string folder = (*argv)[k] + std::strlen(flag);
        std::size_t number = 0;
        for (const std::string &seed : fuzz::seeds())
            test::write_file(folder + "/seed-" + std::to_string(number++), seed);
        std::exit(0);
    }
    return 0;
}
