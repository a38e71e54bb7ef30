// All texts, one after the other in the page, and those that are alike beside each other: so they are smaller with gzip than each among its
// code. Whatever is not named here is there all the same.
import './components/texts';
import './sequence/texts';
import './conditions/texts';
import './forms/texts';
import './forms/exchange_texts';
import './timeline/texts';
import './health/texts';
import './messages/texts';
import './scenario/texts';
import './map/texts';
import './visitors/texts';
import './shell/texts';
import './ui/texts';
