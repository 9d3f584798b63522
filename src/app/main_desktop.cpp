#include "app/program.h"
#include "app/viewer/viewer.h"

int main(int count, char** arguments) {
    return bruma::app::run_program({arguments + 1, arguments + count}, bruma::app::run_viewer);
}
