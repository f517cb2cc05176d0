#include <stdio.h>

int main(void) {
    puts("no benches yet");
    return 0;
}
