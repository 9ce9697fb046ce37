// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_sq/superquadric.h>

int main() {
  return 0;
}
