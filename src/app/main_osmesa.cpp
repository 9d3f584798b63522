#include "app/program.h"

int main(int count, char** arguments) {
    return bruma::app::run_program({arguments + 1, arguments + count}, {});
}
