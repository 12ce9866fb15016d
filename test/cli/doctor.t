The page of the console is reported: where it is, or that it is missing, and how to get it.

  $ page () { "$@" doctor | sed -n '/ console /{p;n;/^   /p}'; }

  $ mkdir page
  $ DOLPHIN_CONSOLE=$PWD/page page dolphin
  --  console       $TESTCASE_ROOT/page has no page: no index.html
                    dolphin console serves only its programming interface: in the sources, scripts/console --build builds the page (it needs npm), and scripts/install installs it; DOLPHIN_CONSOLE names the folder of a page that is elsewhere
  $ touch page/index.html
  $ DOLPHIN_CONSOLE=$PWD/page page dolphin
  ok  console       its page is in $TESTCASE_ROOT/page

A command that is installed without a page:

  $ mkdir bin
  $ cp "$(dirname "$(command -v dolphin)")/../../bin/dolphin.exe" bin/dolphin
  $ page bin/dolphin
  --  console       its page is not installed
                    dolphin console serves only its programming interface: in the sources, scripts/console --build builds the page (it needs npm), and scripts/install installs it; DOLPHIN_CONSOLE names the folder of a page that is elsewhere

With one beside it, as scripts/install puts it:

  $ mkdir -p share/dolphin/console
  $ touch share/dolphin/console/index.html
  $ page bin/dolphin
  ok  console       its page is in $TESTCASE_ROOT/share/dolphin/console
