// SPDX-License-Identifier: MIT
#include "firmware/commands/commands.h"

int main(int argc, char** argv) { return plumbline::commands::run(argc, argv); }
