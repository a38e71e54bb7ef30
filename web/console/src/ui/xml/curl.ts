// A request as a line for a POSIX shell.

export interface CurlOptions {
  origin: string;
  session: string; // empty: none
  token?: string | undefined;
}

export function curl_of(request: string, { origin, session, token }: CurlOptions): string {
  const headers = ['Content-Type: application/xml'];
  if (session !== '') headers.push(`RoIS-Session: ${session}`);
  if (token !== undefined) headers.push(`Authorization: Bearer ${token}`);
  return ['curl -s', ...headers.map((one) => `-H ${quoted(one)}`), `-d ${quoted(without_id(request))}`, quoted(`${origin}/rois`)].join(' ');
}

// The request_id only pairs the console's own answers.
function without_id(request: string): string {
  return request.replace(/^(\s*<[^\s<>/]+[^<>]*?)\srequest_id="[^"]*"/, '$1');
}

function quoted(text: string): string {
  return /^[\w@%+=:,./-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
}
