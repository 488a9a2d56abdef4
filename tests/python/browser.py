"""A browser for tests of pages: sizes, elements, keys, and axe-core."""
import shutil
import subprocess
import sys
import tarfile

AXE = "4.10.2"  # version of axe-core


def browser():
    try:
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service
    except ImportError:
        print("skipped: no python3-selenium")
        sys.exit(77)
    found = shutil.which("chromium"), shutil.which("chromedriver")
    if None in found:
        print("skipped: no chromium and chromium-driver")
        sys.exit(77)
    options = webdriver.ChromeOptions()
    options.binary_location = found[0]
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--host-resolver-rules=MAP * ~NOTFOUND"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(service=Service(found[1]), options=options)


def resize(driver, width, height):
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                           {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500})


def one(driver, selector):
    return driver.find_element("css selector", selector)


def press(driver, *keys):
    from selenium.webdriver import ActionChains
    actions = ActionChains(driver)
    for key in keys:
        actions.send_keys(key)
    actions.perform()


def axe_core(folder):
    """The source of axe-core from the npm registry, kept in the folder; None if npm cannot get it."""
    package = folder / f"axe-core-{AXE}.tgz"
    if not package.exists() and shutil.which("npm"):
        subprocess.run(["npm", "pack", "--silent", f"axe-core@{AXE}", "--pack-destination", folder], capture_output=True, check=False)
    if not package.exists():
        return None
    with tarfile.open(package) as archive:
        return archive.extractfile("package/axe.min.js").read().decode()
