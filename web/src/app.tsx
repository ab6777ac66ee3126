/** Frame of the page: navigation, the view of the address, and the question for a token. */

import { useEffect, useRef, useState } from "preact/hooks";
import { Link, Route, Router, Switch, useLocation } from "wouter-preact";
import { ROOT } from "./api/client";
import { JobsView } from "./jobs/jobs-view";
import { ConnectionNotice } from "./parts/connection-notice";
import { useHashLocation, useHashSearch } from "./parts/hash-location";
import { ForgetToken } from "./parts/forget-token";
import { lazily } from "./parts/lazily";
import { TokenDialog } from "./parts/token-dialog";

const FormView = lazily(() => import("./form/form-view").then((part) => part.FormView));
const JobView = lazily(() => import("./job/job-view").then((part) => part.JobView));
const CompareView = lazily(() => import("./job/compare-view").then((part) => part.CompareView));
const StudiesView = lazily(() => import("./study/studies-view").then((part) => part.StudiesView));
const StudyView = lazily(() => import("./study/study-view").then((part) => part.StudyView));

export function App() {
  return (
    <Router hook={useHashLocation} searchHook={useHashSearch}>
      <a class="skip" href="#main" onClick={focusMain}>
        Skip to the content
      </a>
      <Header />
      <ConnectionNotice />
      <Main />
      <TokenDialog />
    </Router>
  );
}

function Header() {
  return (
    <header class="bar">
      <Link href="/" class="brand">
        <img src={`${ROOT}assets/icon.svg`} alt="" width="24" height="24" /> Scree
      </Link>
      <nav aria-label="Views">
        <NavLink href="/new">New scenario</NavLink>
        <NavLink href="/">Jobs</NavLink>
        <NavLink href="/studies">Studies</NavLink>
        <a href={`${ROOT}docs`}>Interface</a>
      </nav>
      <ForgetToken />
    </header>
  );
}

function NavLink({ href, children }: { href: string; children: string }) {
  const [location] = useLocation();
  const isHere = href === "/" ? location === "/" || location.startsWith("/jobs") : location.startsWith(href);
  return (
    <Link href={href} aria-current={isHere ? "page" : undefined}>
      {children}
    </Link>
  );
}

/** The view of the address; a change of view moves the focus there, for those who hear the page. */
function Main() {
  const [location] = useLocation();
  const main = useRef<HTMLElement>(null);
  const [first, setFirst] = useState(true);
  useEffect(() => {
    if (first) setFirst(false);
    else main.current?.focus({ preventScroll: true });
    window.scrollTo(0, 0);
  }, [location]);
  return (
    <main id="main" ref={main} tabIndex={-1}>
      <Switch>
        <Route path="/">
          <JobsView />
        </Route>
        <Route path="/new">
          <FormView />
        </Route>
        <Route path="/jobs/:id">{({ id }) => <JobView key={id} id={id ?? ""} />}</Route>
        <Route path="/compare/:first/:second">
          {({ first: one, second }) => <CompareView key={`${one} ${second}`} ids={[one ?? "", second ?? ""]} />}
        </Route>
        <Route path="/studies">
          <StudiesView />
        </Route>
        <Route path="/studies/:id">{({ id }) => <StudyView key={id} id={id ?? ""} />}</Route>
        <Route>
          <h1>There is no such view</h1>
          <p>
            <Link href="/">All jobs</Link>
          </p>
        </Route>
      </Switch>
    </main>
  );
}

function focusMain(event: Event) {
  // The address is the view's: a fragment of our own would change it.
  event.preventDefault();
  document.getElementById("main")?.focus();
}
