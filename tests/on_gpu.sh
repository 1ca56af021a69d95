#!/bin/bash
# Runs a command with a GPU for device="gpu": Mesa's lavapipe, a Vulkan device on the processor.
#   on_gpu.sh [--if-possible] COMMAND...
# Debian's package of it is installed where it is missing, which needs root. With VK_DRIVER_FILES
# set, that driver is used; with GPU=own, what the machine has. Taichi takes CUDA or Metal before
# any of them, where they are.
# --if-possible: where it cannot be had, say so and succeed (exit code 0 in place of 2).
# Exit codes: that of the command, or 2.
set -uo pipefail

. "$(dirname "$(realpath "$0")")/options.sh"

PACKAGE=mesa-vulkan-drivers
driver() { find /usr/share/vulkan/icd.d /usr/local/share/vulkan/icd.d -name 'lvp_icd*.json' 2>/dev/null | head -n 1; }

# Installs the driver, or prints why not.
install() {
    if ! grep -qsx 'ID=debian' /etc/os-release; then
        echo "Mesa's lavapipe is not here, and this is not Debian (set VK_DRIVER_FILES to a Vulkan" \
            "driver, or GPU=own to use this machine's)"
    elif [ "$(id -u)" != 0 ]; then
        echo "Mesa's lavapipe is not here, and to install $PACKAGE needs root"
    elif ! { apt-get -qq update && apt-get -qq -y -o DPkg::Lock::Timeout=300 \
        install --no-install-recommends "$PACKAGE"; } >/dev/null 2>&1 || [ -z "$(driver)" ]; then
        echo "$PACKAGE could not be installed"
    fi
}

if [ "${GPU:-}" != own ] && [ -z "${VK_DRIVER_FILES:=${VK_ICD_FILENAMES:-}}" ]; then
    REASON=''
    [ -n "$(driver)" ] || REASON=$(install)
    [ -z "$REASON" ] || skip "tests on a GPU skipped: $REASON"
    VK_DRIVER_FILES=$(driver)
fi
if [ -n "${VK_DRIVER_FILES:-}" ]; then
    export VK_DRIVER_FILES VK_ICD_FILENAMES=$VK_DRIVER_FILES # older loaders know the latter
fi
export CUBIC_CRAFT_DEVICES=gpu
exec "$@"
