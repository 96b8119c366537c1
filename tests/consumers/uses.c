/* The least program that uses the library: from C, through its one header. */
#include <stdio.h>

#include "bvhio.h"

int main(void) {
    printf("%s\n", bvhioVersionText());
    return bvhioVersion() == 0;
}
