// SPDX-License-Identifier: Apache-2.0
// Signing in with user and password, and out again. The session's token is kept for this tab.

import { useEffect, useRef, useState } from "preact/hooks";
import { message_of, post, set_token } from "../api/http";

// The stream and all views begin again with the rights of the other user.
function begin_again(token: string): void {
  set_token(token);
  location.reload();
}

export function SignIn({ close }: { close: () => void }) {
  const dialog = useRef<HTMLDialogElement>(null);
  const [user, set_user] = useState("");
  const [password, set_password] = useState("");
  const [error, set_error] = useState("");
  const [waiting, set_waiting] = useState(false);
  useEffect(() => dialog.current?.showModal(), []);
  const sign_in = async (event: Event) => {
    event.preventDefault();
    set_waiting(true);
    set_error("");
    try {
      begin_again((await post<{ token: string }>("session", { user, password })).token);
    } catch (reason) {
      set_error(message_of(reason));
      set_password("");
    } finally {
      set_waiting(false);
    }
  };
  return (
    <dialog ref={dialog} class="panel sign-in" aria-label="Sign in" onClose={close}>
      <form onSubmit={sign_in}>
        <h2>Sign in</h2>
        <label>User <input name="user" autocomplete="username" autofocus required maxLength={40} value={user}
          onInput={(event) => set_user(event.currentTarget.value)} /></label>
        <label>Password <input name="password" type="password" autocomplete="current-password" required maxLength={200} value={password}
          onInput={(event) => set_password(event.currentTarget.value)} /></label>
        {error && <p class="bad" role="alert">{error}</p>}
        <div class="bar">
          <button type="button" onClick={close}>Cancel</button>
          <button type="submit" disabled={waiting}>Sign in</button>
        </div>
      </form>
    </dialog>);
}

export async function sign_out(): Promise<void> {
  try {
    await post("session/end");
  } finally {
    begin_again("");
  }
}
