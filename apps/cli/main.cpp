#include "program.h"

int main(int argc, char** argv) { return etd::cli::run_program(argc, argv); }
